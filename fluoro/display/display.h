#pragma once
/// Converts the detector's signal to grey levels.
#include <cstdint>
#include <vector>

#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// 8 bits per pixel, row 0 at the top; 0 is black.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;
};

/// Set so that pictures have the tone and grain of cine frames of two makers' systems (the page's table).
struct DisplaySettings {
  double smooth_m = 0.25e-3;  ///< the system's noise filter: standard deviation at the detector
  double compression = 0.5;   ///< share of the logarithmic picture's low frequencies that is removed
  double slow_m = 0.006;      ///< low-pass width: standard deviation at the detector
  double mean_level = 0.44;   ///< grey level of the mean signal, 0 to 1
  double gamma = 0.54;        ///< grey level is the signal to this power
};

/// Scratch planes for `display`, kept from frame to frame to avoid reallocation.
struct DisplayScratch {
  Plane smooth, logarithm, slow, blurred;
};

/// A low-pass against noise, which leaves grains of some pixels; range compression of the logarithm (so that lung and
/// spine fit in one picture); a power law (what is dark shows less noise than by a logarithm, which would make it grow
/// with the square root of what the patient absorbs), with a soft end towards white. `exposed`: area within the
/// shutters, 0 to 1; the rest is black.
void display(const Plane& signal, const Plane& exposed, double field_m, const DisplaySettings& settings,
             DisplayScratch& scratch, Picture& out);

}  // namespace ostium::fluoro
