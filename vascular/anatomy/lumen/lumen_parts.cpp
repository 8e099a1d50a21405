#include "vascular/anatomy/lumen/lumen_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/units.h"
#include "vascular/geometry/centreline/centreline.h"
#include "vascular/geometry/repair/repair.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double vessel_shape = 6;  // a vessel is longer than this many of its widths

/// Of the mesh, along the line between a course's ends: spheres end a radius before a lid, which of a short vessel is
/// much.
double reach_along(const Course& course, const Mesh& mesh) {
  const Eigen::Vector3d along = course.spheres.back().p - course.spheres.front().p;
  if (along.isZero(0)) return 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const double s = p.dot(along.normalized());
    least = std::min(least, s), most = std::max(most, s);
  }
  return most - least;
}

}  // namespace

void require_vessel(double longest_m, double widest_m) {
  if (longest_m <= 0 || longest_m < vessel_shape * widest_m)
    throw MeshError(fmt::format(
        "this is no vessel: the longest way through it is {:.3g} mm, its widest place {:.3g} mm; expected a way at "
        "least {:.0f} times as long as wide",
        longest_m / mm, widest_m / mm, vessel_shape));
}

std::vector<LumenPart> lumen_parts(const Mesh& lumen, const Progress& say) {
  std::vector<LumenPart> parts;
  double longest = 0, widest = 0, largest_m3 = 0;
  for (Mesh& mesh : components_of(lumen)) {
    largest_m3 = std::max(largest_m3, volume_m3(mesh));
    say(fmt::format("looking for centrelines in lumen {}", parts.size() + 1));
    LumenPart part{.mesh = std::move(mesh), .tree = {}, .courses = {}, .root = {}, .roles = {}};
    part.tree = find_centrelines(part.mesh, {.start = {}, .ends = {}, .to_lids = false}).tree;
    if (part.tree.branches.empty() || part.tree.branches[0].spheres.size() < 2) continue;
    part.courses = courses_of(part.tree);
    part.root = part.tree.branches[0].spheres.front().p;
    for (const TreeBranch& branch : part.tree.branches)
      for (const TreeSphere& sphere : branch.spheres) part.widest_m = std::max(part.widest_m, sphere.radius_m);
    for (const Course& course : part.courses)
      longest = std::max({longest, course.length_m(), reach_along(course, part.mesh)});
    widest = std::max(widest, part.widest_m);
    parts.push_back(std::move(part));
  }
  require_vessel(longest, 2 * widest);
  if (largest_m3 < crumb_m3) throw MeshError(too_small);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const LumenPart& a, const LumenPart& b) { return a.widest_m > b.widest_m; });
  return parts;
}

}  // namespace ostium::vascular
