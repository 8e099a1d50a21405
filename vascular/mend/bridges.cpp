#include "vascular/mend/bridges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "vascular/box_tree.h"
#include "vascular/mend/calibre.h"
#include "vascular/tree/centreline.h"

namespace ostium {

namespace {

constexpr std::size_t most_voxels = 1'500'000;
constexpr double widest_share = 0.85;  // of the widest end: that may be the origin too
constexpr double much_wider = 2;
constexpr double like = 1.5;           // ratio of the radii of two ends that are joined
constexpr double facing_cosine = 0.5;  // between the end's direction and the gap
constexpr double end_to_end_cosine = 0.7;

struct End {
  Eigen::Vector3d p, outwards;
  double radius_m;
  bool origin;  ///< may be where its tree begins
};

double median_radius(const std::vector<TreeSphere>& spheres, std::size_t first, std::size_t last) {
  std::vector<double> radii;
  for (std::size_t i = first; i < last; ++i) radii.push_back(spheres[i].radius_m);
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

std::vector<End> ends_of(const SphereTree& tree) {
  std::vector<End> ends;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const std::vector<TreeSphere>& s = tree.branches[b].spheres;
    const std::size_t n = s.size(), few = std::min<std::size_t>(n, 6);
    if (n < 2) continue;
    const auto add = [&](std::size_t tip, std::size_t before, double radius) {
      ends.push_back({s[tip].p, (s[tip].p - s[before].p).normalized(), radius, false});
    };
    add(n - 1, n - few, median_radius(s, n - few, n));
    if (tree.branches[b].parent < 0) add(0, few - 1, median_radius(s, 0, few));
  }
  double widest = 0;
  for (const End& end : ends) widest = std::max(widest, end.radius_m);
  for (End& end : ends) end.origin = end.radius_m > widest_share * widest;
  return ends;
}

/// Of the widest vessel whose wall is at `p`.
double radius_at(const SphereTree& tree, const Eigen::Vector3d& p) {
  double radius = 0;
  for (const TreeBranch& branch : tree.branches)
    for (const TreeSphere& s : branch.spheres)
      if ((s.p - p).norm() < 2.5 * s.radius_m) radius = std::max(radius, s.radius_m);
  return radius;
}

struct Candidate {
  Bridge bridge;
  bool to_wider;
};

}  // namespace

std::vector<Bridge> find_bridges(const std::vector<Mesh>& lumens, double longest_gap_m) {
  const int n = static_cast<int>(lumens.size());
  std::vector<std::vector<End>> ends;
  std::vector<std::unique_ptr<BoxTree>> trees;
  std::vector<SphereTree> lines;
  for (const Mesh& lumen : lumens) {
    lines.push_back(find_centrelines(lumen, {.start = {}, .ends = {}, .most_voxels = most_voxels}).tree);
    ends.push_back(ends_of(lines.back()));
    trees.push_back(std::make_unique<BoxTree>(lumen));
  }
  std::vector<Candidate> candidates;
  for (int i = 0; i < n; ++i)
    for (const End& end : ends[i])
      for (int j = 0; j < n; ++j) {
        if (i == j || !end.origin) continue;
        const BoxTree::Nearest near = trees[j]->nearest(end.p, longest_gap_m + 2 * end.radius_m);
        if (near.triangle < 0) continue;
        const double gap = near.distance_m - end.radius_m;
        if (gap > longest_gap_m) continue;
        const Eigen::Vector3d towards = (near.point - end.p).normalized();
        const double radius_there = radius_at(lines[j], near.point);
        Candidate candidate{{i, j, end.p, near.point, end.radius_m, std::max(0.0, gap), false}, false};
        candidate.to_wider = radius_there > much_wider * end.radius_m;
        const End* other = nullptr;
        for (const End& o : ends[j])
          if ((o.p - near.point).norm() < 2 * o.radius_m &&
              (!other || (o.p - near.point).norm() < (other->p - near.point).norm()))
            other = &o;
        // Straight on, if that is not much farther.
        if (const auto ahead = trees[j]->hits(end.p, end.outwards, near.distance_m * 1.5); !ahead.empty())
          candidate.bridge.p_to = end.p + ahead[0].distance_m * end.outwards;
        // People draw origins that stop short in any direction.
        if (towards.dot(end.outwards) < (candidate.to_wider ? -facing_cosine : facing_cosine)) continue;
        if (!candidate.to_wider) {
          if (other) {
            const double ratio = other->radius_m / end.radius_m;
            if (ratio > like || ratio < 1 / like || other->outwards.dot(end.outwards) > -end_to_end_cosine) continue;
            candidate.bridge.to_end = true;
            candidate.bridge.p_to = other->p;
          } else if (radius_there < end.radius_m / like) {
            continue;
          }
        }
        candidates.push_back(candidate);
      }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.to_wider != b.to_wider) return a.to_wider;
    return a.bridge.gap_m < b.bridge.gap_m;
  });
  std::vector<int> group(static_cast<std::size_t>(n));
  std::iota(group.begin(), group.end(), 0);
  std::vector<Bridge> bridges;
  for (const Candidate& candidate : candidates) {
    const int a = group[candidate.bridge.from], b = group[candidate.bridge.to];
    if (a == b) continue;
    std::replace(group.begin(), group.end(), b, a);
    bridges.push_back(candidate.bridge);
  }
  return bridges;
}

Mesh body_of(const Bridge& bridge, double reach_m) {
  constexpr int columns = 24;
  const Eigen::Vector3d u = (bridge.p_to - bridge.p_from).normalized();
  const Eigen::Vector3d x = u.unitOrthogonal(), y = u.cross(x);
  const Eigen::Vector3d from = bridge.p_from - reach_m * u, to = bridge.p_to + reach_m * u;
  Mesh mesh;
  for (const Eigen::Vector3d& middle : {from, to})
    for (int k = 0; k < columns; ++k) {
      const double angle = 2 * std::numbers::pi * k / columns;
      mesh.vertices.push_back(middle + bridge.radius_m * (std::cos(angle) * x + std::sin(angle) * y));
    }
  mesh.vertices.push_back(from);
  mesh.vertices.push_back(to);
  for (int k = 0; k < columns; ++k) {
    const int next = (k + 1) % columns;
    mesh.triangles.push_back({k, next, columns + k});
    mesh.triangles.push_back({next, columns + next, columns + k});
    mesh.triangles.push_back({2 * columns, next, k});
    mesh.triangles.push_back({2 * columns + 1, columns + k, columns + next});
  }
  return mesh;
}

}  // namespace ostium
