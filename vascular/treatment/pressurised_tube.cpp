#include "vascular/treatment/pressurised_tube.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

using units::pi;

PressurisedTube pressurised_tube(double radius_m, double pressure_Pa, double stretch_N_m) {
  if (!(pressure_Pa > 0) || !(radius_m > 0)) return {};
  const double cube = pi * radius_m * radius_m * radius_m;
  return {cube * stretch_N_m, cube * pressure_Pa};
}

double moment_Nm(const PressurisedTube& tube, double curvature_1_m) {
  const double x = tube.most_Nm > 0 ? tube.EI_N_m2 * curvature_1_m / tube.most_Nm : 0;
  if (x <= 0.5) return tube.EI_N_m2 * curvature_1_m;
  // The wrinkles' angle, by bisection: sin f + (pi - f) cos f falls from pi to 0.
  double low = 0, high = pi;
  for (int i = 0; i < 40; ++i) {
    const double f = (low + high) / 2;
    (2 * x * (std::sin(f) + (pi - f) * std::cos(f)) > pi ? low : high) = f;
  }
  return tube.most_Nm * std::min(1.0, (2 * pi - 2 * low + std::sin(2 * low)) * x / (2 * pi));
}

}  // namespace ostium::vascular
