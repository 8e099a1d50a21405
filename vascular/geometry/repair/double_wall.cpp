#include "vascular/geometry/repair/double_wall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

namespace {

constexpr double thickest_m = 5e-3, thickest_solid_m = 20e-3;
constexpr double farthest_m = 60e-3;     // opposite side of the widest lumen
constexpr double along_surface = 4;      // a shell this many thicknesses away along the surface is a different one
constexpr double narrowest = 0.8;        // a lumen is wider than this many wall thicknesses,
constexpr double narrowest_solid = 0.1;  // or than this many of a wall that is a solid
constexpr double most_uneven = 1.5;      // ratio of a solid's thicknesses on opposite sides of the lumen
constexpr double usual_extent_m = 0.25;
constexpr double rim = 4;              // thicknesses from an outer shell: triangles that may join it to the inner one
constexpr double least_patch = 25;     // smallest area of a patch, in squared thicknesses
constexpr double least_nested = 0.75;  // share of a shell's wall that lies within others: vessels that cross have less
constexpr int most_rays = 60'000;      // in finer meshes, triangles take the label of a nearby one

class ShellFinder {
 public:
  ShellFinder(const Mesh& mesh, const Sheets& sheets) : mesh_(mesh), sheets_(sheets), tree_(mesh) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d area = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]) / 2;
      areas_.push_back(area.norm());
      normals_.push_back(area.norm() > 0 ? Eigen::Vector3d(area.normalized()) : Eigen::Vector3d::UnitX());
      middles_.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
    }
  }

  /// Wall thickness if triangle `t` is part of an outer shell, else 0.
  double thickness(int t) const {
    for (double side : {1.0, -1.0}) {
      const Eigen::Vector3d in = -side * normals_[t];
      const auto inside = tree_.hits(middles_[t] + 1e-7 * in, in, farthest_m);
      if (inside.size() < 2) continue;
      const double wall = inside[0].distance_m, lumen = inside[1].distance_m - wall;
      const bool solid = side > 0 && solid_wall(t, inside);
      if (wall < 2e-5 || wall > (solid ? thickest_solid_m : thickest_m)) continue;
      if (lumen < (solid ? narrowest_solid : narrowest) * wall) continue;
      const double aligned = normals_[inside[0].triangle].dot(normals_[t]);
      if (std::fabs(aligned) < 0.7) continue;
      // A surface that faces this one, seen outwards or of another piece, is a neighbour's (a coil, an artery beside an
      // artery, or through it).
      const bool another = sheets_.piece[inside[0].triangle] != sheets_.piece[t];
      if (aligned < 0 && (side < 0 || another) && sides_known(sheets_)) continue;
      if (another && sides_known(sheets_) && !nested(sheets_.piece[inside[0].triangle])) continue;
      // Of the two sides of a solid, the lumen is the narrower.
      const double free = solid ? std::max(2 * wall, lumen) : 2 * wall;
      if (!tree_.hits(middles_[t] - 1e-7 * in, -in, free).empty()) continue;
      if (reached_along(sheets_, middles_, t, inside[0].triangle, along_surface * wall)) continue;
      return wall;
    }
    return 0;
  }

  /// Whether an outer shell lies within `reach_m` behind triangle `t`.
  bool inner(int t, const std::vector<bool>& outer, double reach_m) const {
    for (double side : {1.0, -1.0}) {
      const auto hits = tree_.hits(middles_[t] + side * 1e-7 * normals_[t], side * normals_[t], reach_m);
      if (!hits.empty() && outer[hits[0].triangle] && std::fabs(normals_[hits[0].triangle].dot(normals_[t])) > 0.5)
        return true;
    }
    return false;
  }

  /// Whether what lies behind triangle `t` of an outer shell is another piece.
  bool around_another(int t) const {
    return std::ranges::any_of(std::array{1.0, -1.0}, [&](double side) {
      const Eigen::Vector3d in = -side * normals_[t];
      const auto inside = tree_.hits(middles_[t] + 1e-7 * in, in, thickest_m);
      return !inside.empty() && sheets_.piece[inside[0].triangle] != sheets_.piece[t];
    });
  }

  double area(int t) const { return areas_[t]; }
  const Eigen::Vector3d& middle(int t) const { return middles_[t]; }

 private:
  /// Whether nearly all of a piece lies within others. One that is partly outside crosses them: a branch, whose
  /// beginning lies in its parent.
  bool nested(int piece) const {
    if (nested_.empty()) {
      nested_.resize(static_cast<std::size_t>(sheets_.pieces));
      triangles_of_.resize(static_cast<std::size_t>(sheets_.pieces));
      for (int t = 0; t < static_cast<int>(sheets_.piece.size()); ++t) triangles_of_[sheets_.piece[t]].push_back(t);
    }
    if (!nested_[piece]) {
      constexpr std::size_t looked_at = 400;
      const std::vector<int>& own = triangles_of_[piece];
      double all = 0, within = 0;
      for (std::size_t k = 0; k < own.size(); k += 1 + own.size() / looked_at) {
        all += areas_[own[k]];
        if (within_others(own[k])) within += areas_[own[k]];
      }
      nested_[piece] = within >= least_nested * all;
    }
    return *nested_[piece];
  }

  /// By how often a ray outwards leaves other pieces.
  bool within_others(int t) const {
    constexpr double anywhere_m = 10;
    int leaves = 0;
    for (const auto& hit : tree_.hits(middles_[t] + 1e-7 * normals_[t], normals_[t], anywhere_m))
      if (sheets_.piece[hit.triangle] != sheets_.piece[t])
        leaves += normals_[hit.triangle].dot(normals_[t]) > 0 ? 1 : -1;
    return leaves != 0;
  }

  /// Whether a ray inwards from triangle `t` goes through a wall that was drawn as one solid: out of it into the lumen,
  /// into it again, and out of as thick a wall as before.
  bool solid_wall(int t, const std::vector<BoundingVolumeHierarchy::Hit>& inside) const {
    if (inside.size() < 3) return false;
    for (int k = 0; k < 3; ++k) {
      const int hit = inside[k].triangle;
      const bool leaves = normals_[hit].dot(normals_[t]) < 0;
      if (sheets_.piece[hit] != sheets_.piece[t] || leaves != (k % 2 == 0)) return false;
    }
    const double ratio = (inside[2].distance_m - inside[1].distance_m) / inside[0].distance_m;
    return ratio < most_uneven && ratio > 1 / most_uneven;
  }

  const Mesh& mesh_;
  const Sheets& sheets_;
  BoundingVolumeHierarchy tree_;
  std::vector<double> areas_;
  std::vector<Eigen::Vector3d> normals_, middles_;
  mutable std::vector<std::optional<bool>> nested_;  ///< of each piece that was asked about
  mutable std::vector<std::vector<int>> triangles_of_;
};

/// Patches of equally labelled triangles; those that satisfy `small` get the other label.
template <class Small>
void absorb(const Sheets& sheets, std::vector<bool>& label, const Small& small) {
  std::vector<bool> seen(label.size());
  std::vector<int> open, patch;
  for (int seed = 0; seed < static_cast<int>(label.size()); ++seed) {
    if (seen[seed]) continue;
    open = patch = {seed};
    seen[seed] = true;
    bool bordered = false;
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int o = sheets.opposite[3 * t + k];
        if (o < 0) continue;
        if (label[o / 3] != label[seed]) bordered = true;
        if (label[o / 3] != label[seed] || seen[o / 3]) continue;
        seen[o / 3] = true;
        open.push_back(o / 3);
        patch.push_back(o / 3);
      }
    }
    if (small(patch, bool(label[seed]), bordered))
      for (int t : patch) label[t] = !label[t];
  }
}

/// A shell that is a piece of its own, round another piece, is outer with its ends, which lie farther from that.
void take_lids_along(const Sheets& sheets, const ShellFinder& finder, std::vector<bool>& outer) {
  constexpr double least_outer = 0.7, least_around = 0.9;  // shares
  constexpr std::size_t looked_at = 3000;
  const auto pieces = static_cast<std::size_t>(sheets.pieces);
  std::vector<double> all(pieces), found(pieces), looked(pieces), around(pieces);
  const std::size_t stride = 1 + outer.size() / looked_at;
  for (std::size_t t = 0; t < outer.size(); ++t) {
    const auto piece = static_cast<std::size_t>(sheets.piece[t]);
    const double area = finder.area(static_cast<int>(t));
    all[piece] += area, found[piece] += outer[t] ? area : 0;
    if (!outer[t] || t % stride != 0) continue;
    looked[piece] += area, around[piece] += finder.around_another(static_cast<int>(t)) ? area : 0;
  }
  for (std::size_t t = 0; t < outer.size(); ++t) {
    const auto piece = static_cast<std::size_t>(sheets.piece[t]);
    if (found[piece] >= least_outer * all[piece] && looked[piece] > 0 && around[piece] >= least_around * looked[piece])
      outer[t] = true;
  }
}

}  // namespace

DoubleWall find_double_wall(const Mesh& mesh, const Sheets& sheets) {
  DoubleWall result;
  const int n = static_cast<int>(mesh.triangles.size());
  result.outer.assign(static_cast<std::size_t>(n), false);
  const ShellFinder finder(mesh, sheets);
  const int stride = 1 + n / most_rays;
  std::vector<double> thickness;
  // Sample first: most meshes have a single wall.
  int looked = 0, doubled = 0;
  for (int t = 0; t < n; t += std::max(1, n / 3000)) ++looked, doubled += finder.thickness(t) > 0 ? 1 : 0;
  if (doubled < 0.01 * looked) return result;
  std::vector<bool> known(static_cast<std::size_t>(n));
  std::queue<int> spread;
  for (int t = 0; t < n; t += stride) {
    const double d = finder.thickness(t);
    if (d > 0) thickness.push_back(d);
    result.outer[t] = d > 0;
    known[t] = true;
    spread.push(t);
  }
  while (!spread.empty()) {
    const int t = spread.front();
    spread.pop();
    for (int k = 0; k < 3; ++k)
      if (const int o = sheets.opposite[3 * t + k]; o >= 0 && !known[o / 3]) {
        known[o / 3] = true;
        result.outer[o / 3] = result.outer[t];
        spread.push(o / 3);
      }
  }
  if (thickness.empty()) return result;
  std::nth_element(thickness.begin(), thickness.begin() + static_cast<long>(thickness.size() / 2), thickness.end());
  result.thickness_m = thickness[thickness.size() / 2];

  for (int round = 0; round < 4; ++round) {
    std::vector<bool> next = result.outer;
    for (int t = 0; t < n; ++t) {
      int same = 0, others = 0;
      for (int k = 0; k < 3; ++k)
        if (const int o = sheets.opposite[3 * t + k]; o >= 0)
          (result.outer[o / 3] == result.outer[t] ? same : others)++;
      if (others > same) next[t] = !next[t];
    }
    result.outer = std::move(next);
  }
  const double least = least_patch * result.thickness_m * result.thickness_m;
  const auto area_of = [&](const std::vector<int>& patch) {
    double area = 0;
    for (int t : patch) area += finder.area(t);
    return area;
  };
  absorb(sheets, result.outer,
         [&](const std::vector<int>& patch, bool, bool bordered) { return bordered && area_of(patch) < least; });
  absorb(sheets, result.outer,
         [&](const std::vector<int>& patch, bool outer, bool) { return outer && area_of(patch) < least; });
  // Rims at the ends that join the shells.
  const double reach = std::max(thickest_m, 2 * result.thickness_m);
  std::queue<std::pair<int, double>> open;
  for (int t = 0; t < n; ++t)
    if (result.outer[t]) open.push({t, 0});
  while (!open.empty()) {
    const auto [t, d] = open.front();
    open.pop();
    for (int k = 0; k < 3; ++k) {
      const int o = sheets.opposite[3 * t + k];
      if (o < 0 || result.outer[o / 3]) continue;
      const double next = d + (finder.middle(o / 3) - finder.middle(t)).norm();
      if (next > rim * result.thickness_m || finder.inner(o / 3, result.outer, reach)) continue;
      result.outer[o / 3] = true;
      open.push({o / 3, next});
    }
  }
  take_lids_along(sheets, finder, result.outer);
  for (int t = n - 1; t >= 0; --t)
    if (result.outer[t]) ++result.triangles, result.where = finder.middle(t);
  return result;
}

Mesh without_outer_wall(Mesh mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  if (!(box.sizes().maxCoeff() > 0)) return mesh;
  Mesh usual = mesh;
  for (Eigen::Vector3d& p : usual.vertices) p = usual_extent_m / box.sizes().maxCoeff() * (p - box.center());
  Sheets sheets = sheets_of(usual);
  orient(usual, sheets);
  const DoubleWall wall = find_double_wall(usual, sheets);
  if (wall.triangles == 0) return mesh;
  std::size_t t = 0;
  std::erase_if(usual.triangles, [&](const std::array<int, 3>&) { return wall.outer[t++]; });
  sheets = sheets_of(usual);
  orient(usual, sheets);
  mesh.triangles = usual.triangles;
  return mesh;
}

}  // namespace ostium::vascular
