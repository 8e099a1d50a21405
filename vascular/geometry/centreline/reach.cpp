#include "vascular/geometry/centreline/reach.h"

#include <algorithm>
#include <limits>

namespace ostium::vascular {

namespace {

constexpr std::size_t most_looked_at = 4000;
constexpr double radii = 3, more_m = 1.5e-3;

/// Distance beyond what the nearest sphere accounts for; not positive: none.
double beyond_m(const SphereTree& tree, const Eigen::Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const TreeBranch& branch : tree.branches)
    for (const TreeSphere& sphere : branch.spheres)
      least = std::min(least, (p - sphere.p).norm() - radii * sphere.radius_m - more_m);
  return least;
}

}  // namespace

Unreached unreached(const Mesh& lumen, const SphereTree& tree) {
  Unreached out;
  const std::size_t step = std::max<std::size_t>(1, (lumen.vertices.size() + most_looked_at - 1) / most_looked_at);
  std::size_t looked_at = 0, beyond = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < lumen.vertices.size(); v += step, ++looked_at) {
    const double by_m = beyond_m(tree, lumen.vertices[v]);
    if (by_m <= 0) continue;
    ++beyond;
    if (by_m < nearest_m) nearest_m = by_m, out.p = lumen.vertices[v];
  }
  if (looked_at) out.share = static_cast<double>(beyond) / static_cast<double>(looked_at);
  double near_m = std::numeric_limits<double>::infinity();
  for (const TreeBranch& branch : tree.branches)
    for (std::size_t i = 0; i < branch.spheres.size() && beyond > 0; ++i) {
      const double d = (branch.spheres[i].p - out.p).norm();
      if (d >= near_m) continue;
      const bool ends = i + 1 == branch.spheres.size();
      near_m = d, out.branch = ends ? branch.name : "", out.after_m = ends ? branch.spheres[i].s_m : 0;
    }
  return out;
}

}  // namespace ostium::vascular
