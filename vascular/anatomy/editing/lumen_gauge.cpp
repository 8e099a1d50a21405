#include "vascular/anatomy/editing/lumen_gauge.h"

#include <cmath>

namespace ostium::vascular {

namespace {

constexpr double no_farther_m = 1;               // no wall is looked for beyond
constexpr int directions = 8, most_steps = 100;  // tried about a point
constexpr double shortest_step_m = 5e-6;         // a step too short to matter

}  // namespace

LumenGauge::LumenGauge(const Mesh& closed) : winding_(closed), wall_(closed) {}

double LumenGauge::clearance_m(const Eigen::Vector3d& p) const {
  const double away_m = wall_.nearest(p, no_farther_m).distance_m;
  return winding_.inside(p) ? away_m : -away_m;
}

Eigen::Vector3d LumenGauge::centred(const Eigen::Vector3d& p, const Eigen::Vector3d& along) const {
  Eigen::Vector3d best = p;
  double clearance = clearance_m(p);
  if (clearance <= 0) return p;
  const Eigen::Vector3d u = along.unitOrthogonal(), v = along.cross(u);
  int steps = 0;
  for (double step = clearance / 2; step > shortest_step_m && steps < most_steps; ++steps) {
    const Eigen::Vector3d from = best;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * M_PI * k / directions;
      const Eigen::Vector3d to = from + step * (std::cos(angle) * u + std::sin(angle) * v);
      if (const double there = clearance_m(to); there > clearance) clearance = there, best = to;
    }
    if (best == from) step /= 2;
  }
  return best;
}

}  // namespace ostium::vascular
