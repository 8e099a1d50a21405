#pragma once
/// How the operator's picture is taken and shown. It changes nothing of what is simulated, so no recording holds it.
#include "fluoro/detector/exposure.h"
#include "fluoro/display/display.h"

namespace ostium::app {

struct PictureSettings {
  double frames_per_s = 15;  ///< of fluoroscopy and cine: 3.75, 7.5, 15, 30
  fluoro::Collimator shutters = fluoro::to_field;
  bool roadmap = false;
  double gamma = 1, level = 0.5, width = 1;  ///< of the shown greys; shares of all of them
  int review = 0;                            ///< the last cine run is 1; 0: live
  int review_frame = 0;
  int references = 0;  ///< how often the picture was made the reference
};

/// The greys as they are shown.
void window_greys(const PictureSettings& settings, fluoro::Picture& picture);

}  // namespace ostium::app
