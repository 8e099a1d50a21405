#pragma once
/// From the detector's signal to grey levels.
#include <cstdint>
#include <vector>

#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// 8 bits a pixel, row 0 at the top; 0 is black.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;
};

struct DisplaySettings {
  double compression = 0.55;  ///< share of the slow part of the logarithmic picture that is taken away
  double slow_m = 0.012;      ///< what is slow: standard deviation at the detector
  double mean_level = 0.66;   ///< grey of the mean signal, of 1
  double contrast = 0.42;     ///< grey levels (of 1) per unit of natural logarithm
};

/// Planes that are only good while `display` runs; kept from frame to frame to save their making.
struct DisplayScratch {
  Plane logarithm, slow, blurred;
};

/// Logarithm (equal thickness, equal step), range compression (so that lung and spine fit one picture), then a curve
/// whose ends are soft. `exposed`: where the shutters let the beam through, 0 to 1; the rest is black.
void display(const Plane& signal, const Plane& exposed, double field_m, const DisplaySettings& settings,
             DisplayScratch& scratch, Picture& out);

}  // namespace ostium::fluoro
