#include "vascular/anatomy/labelling/narrowings.h"

#include <algorithm>
#include <iterator>

namespace ostium::vascular {

namespace {

constexpr double near_m = 4e-3, far_m = 16e-3;  // stretch to compare with, proximally and distally
constexpr double widest_m = 4e-3;               // radius
/// Where the vessel is wider than that many times its other side, it tapers no more: it bulges.
constexpr double most_taper = 1.5;
/// Narrow places with less between them are one lesion: Sianos et al. 2005 (SYNTAX score), EuroIntervention 1:219.
constexpr double apart_diameters = 3;

double median_between(const TreeBranch& branch, double from, double to) {
  std::vector<double> radii;
  for (const TreeSphere& sphere : branch.spheres)
    if (sphere.s_m >= from && sphere.s_m <= to) radii.push_back(sphere.radius_m);
  if (radii.size() < 3) return 0;
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

/// As far as half of its own depth, where that is less than what makes it a narrowing: a mild one is not short for
/// that.
void reach_half_depth(const TreeBranch& branch, double least, FoundNarrowing& found) {
  const double edge_m = found.reference_m / 2 * (1 - std::min(least, found.stenosis / 2));
  const auto& spheres = branch.spheres;
  const auto narrowest = std::ranges::find(spheres, found.at_m, &TreeSphere::s_m);
  const auto wide = [&](const TreeSphere& sphere) { return sphere.radius_m > edge_m; };
  const auto behind = std::find_if(narrowest, spheres.end(), wide);
  const auto before = std::find_if(std::make_reverse_iterator(narrowest), spheres.rend(), wide);
  if (behind != spheres.end()) found.to_m = std::max(found.to_m, std::prev(behind)->s_m);
  if (before != spheres.rend()) found.from_m = std::min(found.from_m, before.base()->s_m);
}

}  // namespace

std::vector<FoundNarrowing> find_narrowings(const SphereTree& tree, double least) {
  std::vector<FoundNarrowing> found;
  for (const TreeBranch& branch : tree.branches) {
    const double length = branch.spheres.back().s_m;
    const std::size_t before_it = found.size();
    double last_m = -1;  // where the branch was narrow last; < 0: nowhere yet
    for (const TreeSphere& sphere : branch.spheres) {
      const double before = median_between(branch, sphere.s_m - far_m, sphere.s_m - near_m);
      const double behind = median_between(branch, sphere.s_m + near_m, sphere.s_m + far_m);
      // An end tapers; a narrowing has wide vessel on both sides.
      if (before <= 0 || behind <= 0 || sphere.s_m >= length - 2 * near_m || before >= widest_m) continue;
      if (behind < 0.5 * before || before < 0.5 * behind) continue;
      const double reference = std::min(before, behind) *
                               (1 + std::min(most_taper, std::max(before, behind) / std::min(before, behind))) / 2;
      const double stenosis = 1 - sphere.radius_m / reference;
      if (stenosis < least) continue;
      FoundNarrowing here = {.branch = branch.name,
                             .at_m = sphere.s_m,
                             .from_m = sphere.s_m,
                             .to_m = sphere.s_m,
                             .stenosis = stenosis,
                             .reference_m = 2 * reference,
                             .p = sphere.p};
      if (last_m < 0 || sphere.s_m - last_m > apart_diameters * here.reference_m) found.push_back(here);
      here.from_m = found.back().from_m;
      if (stenosis > found.back().stenosis) found.back() = here;
      found.back().to_m = sphere.s_m;
      last_m = sphere.s_m;
    }
    for (std::size_t i = before_it; i < found.size(); ++i) reach_half_depth(branch, least, found[i]);
  }
  return found;
}

double narrowest_m(const std::vector<FoundNarrowing>& narrowings) {
  double narrowest = 0;
  for (const FoundNarrowing& n : narrowings)
    if (const double throat_m = (1 - n.stenosis) * n.reference_m; narrowest == 0 || throat_m < narrowest)
      narrowest = throat_m;
  return narrowest;
}

}  // namespace ostium::vascular
