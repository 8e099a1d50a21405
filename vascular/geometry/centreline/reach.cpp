#include "vascular/geometry/centreline/reach.h"

#include <algorithm>
#include <limits>

namespace ostium::vascular {

namespace {

constexpr std::size_t most_looked_at = 4000;
constexpr double radii = 3, more_m = 1.5e-3;

/// Distance beyond what a sphere accounts for; not positive: none.
double beyond_m(const TreeSphere& sphere, const Eigen::Vector3d& p) {
  return (p - sphere.p).norm() - radii * sphere.radius_m - more_m;
}
double beyond_m(const SphereTree& tree, const Eigen::Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const TreeBranch& branch : tree.branches)
    for (const TreeSphere& sphere : branch.spheres) least = std::min(least, beyond_m(sphere, p));
  return least;
}

}  // namespace

Unreached unreached(const Mesh& lumen, const SphereTree& tree) {
  Unreached out;
  const std::size_t step = std::max<std::size_t>(1, (lumen.vertices.size() + most_looked_at - 1) / most_looked_at);
  std::size_t looked_at = 0;
  std::vector<Eigen::Vector3d> rest;  // beyond all spheres
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < lumen.vertices.size(); v += step, ++looked_at) {
    const double by_m = beyond_m(tree, lumen.vertices[v]);
    if (by_m <= 0) continue;
    rest.push_back(lumen.vertices[v]);
    if (by_m < nearest_m) nearest_m = by_m, out.p = lumen.vertices[v];
  }
  if (looked_at) out.share = static_cast<double>(rest.size()) / static_cast<double>(looked_at);
  // Of the branches that end at what is beyond, the widest: those that end by themselves are narrow.
  double widest_m = 0;
  for (const TreeBranch& branch : tree.branches) {
    if (branch.spheres.empty() || branch.spheres.back().radius_m <= widest_m) continue;
    const TreeSphere& end = branch.spheres.back();
    const auto is_at_end = [&](const Eigen::Vector3d& p) { return beyond_m(end, p) < 1e-3; };
    const auto there = std::find_if(rest.begin(), rest.end(), is_at_end);
    if (there == rest.end()) continue;
    widest_m = end.radius_m, out.p = *there, out.branch = branch.name;
  }
  return out;
}

}  // namespace ostium::vascular
