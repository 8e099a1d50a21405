#pragma once
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Image lag: shown = (1 - lag) new + lag previously shown. A step reaches 1 - lag^n after n pictures. Combines
/// detector lag and the system's recursive noise filter; noise falls by sqrt((1 - lag) / (1 + lag)).
struct Lag {
  Plane shown;  ///< empty before the first picture, which is shown unfiltered

  void add(const Plane& picture, double lag) {
    if (shown.rows() != picture.rows() || shown.cols() != picture.cols())
      shown = picture;
    else
      shown += static_cast<float>(1 - lag) * (picture - shown);
  }
};

}  // namespace ostium::fluoro
