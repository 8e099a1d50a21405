#include "vascular/treatment/pressurised_tube.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

using units::pi;

PressurisedTube pressurised_tube(double radius_m, double pressure_Pa, double stretch_N_m) {
  if (!(pressure_Pa > 0) || !(radius_m > 0)) return {};
  const double cube = pi * radius_m * radius_m * radius_m;
  return {cube * stretch_N_m, cube * pressure_Pa};
}

namespace {

/// Curvature and moment as shares of M / EI and M, by the wrinkles' angle; from where wrinkles begin.
struct Wrinkled {
  static constexpr int entries = 256;
  std::array<double, entries> x, m;
  Wrinkled() {
    for (std::size_t i = 0; i < entries; ++i) {
      const double f = pi * static_cast<double>(i) / entries, below = std::sin(f) + (pi - f) * std::cos(f);
      x[i] = pi / (2 * below), m[i] = (2 * pi - 2 * f + std::sin(2 * f)) / (4 * below);
    }
  }
};

}  // namespace

double moment_Nm(const PressurisedTube& tube, double curvature_1_m) {
  const double x = tube.most_Nm > 0 ? tube.EI_N_m2 * curvature_1_m / tube.most_Nm : 0;
  if (x <= 0.5) return tube.EI_N_m2 * curvature_1_m;
  static const Wrinkled table;
  const auto above = std::upper_bound(table.x.begin(), table.x.end(), x);
  if (above == table.x.end()) return tube.most_Nm;
  const auto i = static_cast<std::size_t>(above - table.x.begin());
  const double part = (x - table.x[i - 1]) / (table.x[i] - table.x[i - 1]);
  return tube.most_Nm * (table.m[i - 1] + part * (table.m[i] - table.m[i - 1]));
}

}  // namespace ostium::vascular
