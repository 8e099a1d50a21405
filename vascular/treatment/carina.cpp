#include "vascular/treatment/carina.h"

#include <algorithm>
#include <cmath>

#include "vascular/treatment/stent_shape.h"

namespace ostium::vascular {

namespace {

constexpr double looks_ahead_m = 4e-3;  // along a daughter, to see where it goes

/// The cell that lies about so far behind another along its branch.
int ahead(const FlowTree& tree, int cell, double far_m) {
  const int last = tree.branches[static_cast<std::size_t>(tree.cells[static_cast<std::size_t>(cell)].branch)].last - 1;
  const double from_m = tree.s_of(cell);
  while (cell < last && tree.s_of(cell) - from_m < far_m) ++cell;
  return cell;
}

}  // namespace

std::vector<Fork> make_forks(const FlowTree& tree) {
  std::vector<Fork> forks;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const FlowBranch& side = tree.branches[b];
    if (side.parent < 0 || side.parent_cell < 0) continue;
    int main_cell = -1;
    if (side.parent_cell + 1 < tree.branches[static_cast<std::size_t>(side.parent)].last) {
      main_cell = side.parent_cell + 1;
    } else {
      // At its end: the widest of the others is the main one.
      double most_m = tree.cells[static_cast<std::size_t>(side.first)].healthy_m;
      for (std::size_t other = 0; other < tree.branches.size(); ++other)
        if (const FlowBranch& its = tree.branches[other]; other != b && its.parent_cell == side.parent_cell)
          if (const double r = tree.cells[static_cast<std::size_t>(its.first)].healthy_m; r > most_m)
            main_cell = its.first, most_m = r;
    }
    if (main_cell >= 0) forks.push_back({.main_cell = main_cell, .side_cell = side.first});
  }
  return forks;
}

std::vector<Fork> make_forks(const FlowTree& tree, const LumenMap& map, const std::vector<VesselPath>& paths) {
  std::vector<Fork> forks = make_forks(tree);
  const auto centre = [&](int cell) { return map.centre(static_cast<std::size_t>(cell), {}); };
  for (Fork& fork : forks) {
    const FlowBranch& side =
        tree.branches[static_cast<std::size_t>(tree.cells[static_cast<std::size_t>(fork.side_cell)].branch)];
    const Eigen::Vector3d from = centre(side.parent_cell),
                          into_main = (centre(ahead(tree, fork.main_cell, looks_ahead_m)) - from).normalized(),
                          into_side = (centre(ahead(tree, fork.side_cell, looks_ahead_m)) - from).normalized();
    fork.cosine = std::max(0.0, into_main.dot(into_side));
    const VesselPath& path =
        paths[static_cast<std::size_t>(tree.cells[static_cast<std::size_t>(fork.main_cell)].branch)];
    const auto at = std::find(path.cells.begin(), path.cells.end(), side.parent_cell);
    if (at == path.cells.end()) continue;
    const PathFrame frame = frame_at(map, path, path.s_m[static_cast<std::size_t>(at - path.cells.begin())], {});
    fork.angle_rad = std::atan2(into_side.dot(frame.up), into_side.dot(frame.side));
  }
  return forks;
}

double shifted_carina_m(const FlowTree& tree, const Fork& fork, const AtFork& balloons, double was_m) {
  const auto healthy_m = [&](int cell) { return tree.cells[static_cast<std::size_t>(cell)].healthy_m; };
  const double from_main_m = 2 * fork.cosine * (balloons.main_m - healthy_m(fork.main_cell)),
               from_side_m = 2 * fork.cosine * (healthy_m(fork.side_cell) - balloons.side_m);
  // Between what each balloon lets it have; where both want more than there is, they share.
  if (balloons.main_m > 0 && balloons.side_m > 0 && from_main_m > from_side_m) return (from_main_m + from_side_m) / 2;
  if (balloons.main_m > 0) was_m = std::max(was_m, from_main_m);
  if (balloons.side_m > 0) was_m = std::min(was_m, from_side_m);
  return was_m;
}

double mouth_left(double radius_m, double taken_m) {
  return std::sqrt(std::clamp(1 - taken_m / (2 * radius_m), 0.05, 1.0));
}

}  // namespace ostium::vascular
