#pragma once
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// What is still seen of the pictures before: shown = (1 - lag) new + lag shown before. A step reaches 1 - lag^n after
/// n pictures. Detector lag and the system's recursive noise filter together; noise falls by sqrt((1 - lag) / (1 +
/// lag)).
struct Lag {
  Plane shown;  ///< empty before the first picture, which is shown as it is

  void add(const Plane& picture, double lag) {
    if (shown.rows() != picture.rows() || shown.cols() != picture.cols())
      shown = picture;
    else
      shown += static_cast<float>(1 - lag) * (picture - shown);
  }
};

}  // namespace ostium::fluoro
