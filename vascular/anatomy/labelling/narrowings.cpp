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
constexpr double healthy_share = 0.85;  ///< of the branch's line: what is narrower has no part in it
constexpr double bulging_share = 1.25;  ///< what is wider neither
constexpr double first_share = 0.6;     ///< of the branch's median radius, and its inverse: the first round takes that
constexpr int line_rounds = 8;

/// Length that a sphere stands for: where a vessel is narrow they lie denser.
double length_at(const TreeBranch& branch, std::size_t i) {
  const auto& spheres = branch.spheres;
  return (spheres[std::min(i + 1, spheres.size() - 1)].s_m - spheres[i == 0 ? 0 : i - 1].s_m) / 2;
}

/// By length; 0 of fewer than three spheres.
double median_between(const TreeBranch& branch, double from, double to) {
  std::vector<std::pair<double, double>> radii;  // and lengths
  double all_m = 0;
  for (std::size_t i = 0; i < branch.spheres.size(); ++i)
    if (const TreeSphere& sphere = branch.spheres[i]; sphere.s_m >= from && sphere.s_m <= to)
      radii.emplace_back(sphere.radius_m, length_at(branch, i)), all_m += radii.back().second;
  if (radii.size() < 3) return 0;
  std::ranges::sort(radii);
  double below_m = 0;
  for (const auto& [radius_m, length_m] : radii)
    if ((below_m += length_m) >= all_m / 2) return radius_m;
  return radii.back().first;
}

/// The healthy branch: a line through its radii, without those that lie well below it, or above.
struct HealthyLine {
  double radius_m = 0, per_m = 0;
  double at(double s_m) const { return radius_m + per_m * s_m; }
};

/// Zero of a branch too short for one.
HealthyLine line_of(const TreeBranch& branch) {
  HealthyLine line{median_between(branch, 0, branch.spheres.back().s_m), 0};
  for (int round = 0; round < line_rounds; ++round) {
    const double least = round == 0 ? first_share : healthy_share, most = round == 0 ? 1 / first_share : bulging_share;
    double n = 0, s = 0, r = 0, ss = 0, sr = 0;
    int spheres = 0;
    for (std::size_t i = 0; i < branch.spheres.size(); ++i) {
      const TreeSphere& sphere = branch.spheres[i];
      const double share = sphere.radius_m / line.at(sphere.s_m), w = length_at(branch, i);
      if (!(share >= least && share <= most)) continue;
      ++spheres, n += w, s += w * sphere.s_m, r += w * sphere.radius_m;
      ss += w * sphere.s_m * sphere.s_m, sr += w * sphere.s_m * sphere.radius_m;
    }
    const double spread = n * ss - s * s;
    if (spheres < 3 || !(spread > 0)) return {};
    const double per_m = (n * sr - s * r) / spread;
    line = {(r - per_m * s) / n, per_m};
  }
  return line;
}

/// Whether the branch is as wide as its line somewhere between two positions; never past its end, which tapers.
bool is_wide(const TreeBranch& branch, const HealthyLine& line, double from, double to) {
  const double last = branch.spheres.back().s_m - 2 * near_m;
  for (double at = std::max(from, 0.0); at + near_m <= std::min(to, last); at += near_m / 2)
    if (median_between(branch, at, at + near_m) >= healthy_share * line.at(at + near_m / 2)) return true;
  return false;
}

/// Radius that a place would have if it were healthy: by what lies beside it; where that is narrow, too, by the whole
/// branch, if it is wide on both sides. 0: nothing tells.
double reference_at(const TreeBranch& branch, const HealthyLine& line, double s_m) {
  const double before = median_between(branch, s_m - far_m, s_m - near_m);
  const double behind = median_between(branch, s_m + near_m, s_m + far_m);
  double reference = 0;
  // An end tapers; a narrowing has wide vessel on both sides.
  if (before > 0 && behind > 0 && behind >= 0.5 * before && before >= 0.5 * behind)
    reference =
        std::min(before, behind) * (1 + std::min(most_taper, std::max(before, behind) / std::min(before, behind))) / 2;
  const double healthy = line.at(s_m);
  if (reference >= healthy_share * healthy || healthy <= 0) return reference;
  const double length = branch.spheres.back().s_m;
  return is_wide(branch, line, 0, s_m) && is_wide(branch, line, s_m, length) ? healthy : reference;
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
    const HealthyLine line = line_of(branch);
    double last_m = -1;  // where the branch was narrow last; < 0: nowhere yet
    for (const TreeSphere& sphere : branch.spheres) {
      if (sphere.s_m >= length - 2 * near_m) continue;
      const double reference = reference_at(branch, line, sphere.s_m);
      if (reference <= 0 || reference >= widest_m) continue;
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
