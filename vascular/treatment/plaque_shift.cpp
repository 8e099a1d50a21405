#include "vascular/treatment/plaque_shift.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

using units::pi;

namespace {

constexpr double shifts = 0.08;      // alpha
constexpr double least_left = 0.05;  // of a mouth's area

/// Area at the mouth's edge: the volume is half of edge times length.
double edge_m2(double plaque_m3) { return 2 * plaque_m3 / plaque_reach_m; }

}  // namespace

double pushed_plaque_m3(const FlowTree& tree, const PlaqueModel& plaque, const PlaqueState& wall, const Fork& fork) {
  const auto square = [](double r) { return r * r; };
  double sum_m3 = 0, way_m = 0;
  int cell = tree.cells[static_cast<std::size_t>(fork.side_cell)].upstream;
  while (cell >= 0 && way_m < plaque_reach_m) {
    const auto c = static_cast<std::size_t>(cell);
    const PlaqueCell& own = plaque.cells[c];
    const double length_m = std::min(tree.cells[c].length_m, plaque_reach_m - way_m),
                 all_m2 = square(own.healthy_m) - square(own.diseased_m),
                 taken_m2 = square(wall.peak_m[c]) - square(own.diseased_m);
    sum_m3 += pi * std::clamp(taken_m2, 0.0, std::max(0.0, all_m2)) * length_m;
    way_m += tree.cells[c].length_m, cell = tree.cells[c].upstream;
  }
  return shifts * sum_m3;
}

double plaque_left_m3(const FlowTree& tree, const Fork& fork, double plaque_m3, double balloon_m) {
  if (balloon_m <= 0) return plaque_m3;
  const double healthy_m = tree.cells[static_cast<std::size_t>(fork.side_cell)].healthy_m;
  const double room_m2 = pi * std::max(0.0, healthy_m * healthy_m - balloon_m * balloon_m);
  return std::min(plaque_m3, room_m2 * plaque_reach_m / 2);
}

double mouth_beside_plaque(double radius_m, double plaque_m3, double way) {
  const double taken = edge_m2(plaque_m3) * std::max(0.0, 1 - way) / (pi * radius_m * radius_m);
  return std::sqrt(std::max(least_left, 1 - taken));
}

}  // namespace ostium::vascular
