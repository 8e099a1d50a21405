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

struct DisplaySettings {
  double compression = 0.55;  ///< share of the logarithmic picture's low frequencies that is removed
  double slow_m = 0.012;      ///< low-pass width: standard deviation at the detector
  double mean_level = 0.66;   ///< grey level of the mean signal, 0 to 1
  double contrast = 0.42;     ///< grey levels (of 1) per unit of natural logarithm
};

/// Scratch planes for `display`, kept from frame to frame to avoid reallocation.
struct DisplayScratch {
  Plane logarithm, slow, blurred;
};

/// Logarithm (equal thickness gives an equal step), range compression (so that lung and spine fit in one picture), then
/// a curve with soft ends. `exposed`: area within the shutters, 0 to 1; the rest is black.
void display(const Plane& signal, const Plane& exposed, double field_m, const DisplaySettings& settings,
             DisplayScratch& scratch, Picture& out);

}  // namespace ostium::fluoro
