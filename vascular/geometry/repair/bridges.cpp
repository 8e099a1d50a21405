#include "vascular/geometry/repair/bridges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/base/units.h"
#include "vascular/geometry/centreline/centreline.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/repair/calibre.h"

namespace ostium::vascular {

namespace {

constexpr std::size_t most_voxels = 1'500'000;
constexpr double widest_share = 0.85;  // of the widest end: an end this wide may be the origin, too
constexpr double much_wider = 2;
constexpr double like = 1.5;           // largest ratio of the radii of two joined ends
constexpr double facing_cosine = 0.5;  // between an end's direction and the gap
constexpr double end_to_end_cosine = 0.7;

double widest_radius(const std::vector<TreeSphere>& spheres, std::size_t first, std::size_t last) {
  double widest = 0;
  for (std::size_t i = first; i < last; ++i) widest = std::max(widest, spheres[i].radius_m);
  return widest;
}

double median_radius(const std::vector<TreeSphere>& spheres, std::size_t first, std::size_t last) {
  std::vector<double> radii;
  for (std::size_t i = first; i < last; ++i) radii.push_back(spheres[i].radius_m);
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

std::vector<VesselEnd> ends_of(const SphereTree& tree) {
  std::vector<VesselEnd> ends;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const std::vector<TreeSphere>& s = tree.branches[b].spheres;
    const std::size_t n = s.size(), few = std::min<std::size_t>(n, 6);
    if (n < 2) continue;
    const auto add = [&](std::size_t tip, std::size_t before) {
      const std::size_t first = std::min(tip, before), last = first + few;
      ends.push_back({s[tip].p, (s[tip].p - s[before].p).normalized(), median_radius(s, first, last),
                      widest_radius(s, first, last), false});
    };
    add(n - 1, n - few);
    if (tree.branches[b].parent < 0) add(0, few - 1);
  }
  double widest = 0;
  for (const VesselEnd& end : ends) widest = std::max(widest, end.radius_m);
  for (VesselEnd& end : ends) end.origin = end.radius_m > widest_share * widest;
  return ends;
}

/// Radius of the widest vessel whose wall contains `p`.
double radius_at(const SphereTree& tree, const Eigen::Vector3d& p) {
  double radius = 0;
  for (const TreeBranch& branch : tree.branches)
    for (const TreeSphere& s : branch.spheres)
      if ((s.p - p).norm() < 2.5 * s.radius_m) radius = std::max(radius, s.radius_m);
  return radius;
}

Eigen::Vector3d outward_normal(const Mesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized();
}

struct Candidate {
  Bridge bridge;
  bool to_wider;
};

/// A bridge begins inside its vessel, so lines do, too.
SphereTree lines_of(const Mesh& lumen) {
  return find_centrelines(lumen, {.start = {}, .ends = {}, .to_lids = false, .most_voxels = most_voxels}).tree;
}

}  // namespace

std::vector<VesselEnd> ends_of(const Mesh& lumen) { return ends_of(lines_of(lumen)); }

std::vector<Bridge> find_bridges(const std::vector<Mesh>& lumens, double longest_gap_m) {
  const int n = static_cast<int>(lumens.size());
  std::vector<std::vector<VesselEnd>> ends;
  std::vector<std::unique_ptr<BoundingVolumeHierarchy>> trees;
  std::vector<SphereTree> lines;
  for (const Mesh& lumen : lumens) {
    lines.push_back(lines_of(lumen));
    ends.push_back(ends_of(lines.back()));
    trees.push_back(std::make_unique<BoundingVolumeHierarchy>(lumen));
  }
  std::vector<Candidate> candidates;
  for (int i = 0; i < n; ++i)
    for (const VesselEnd& end : ends[i])
      for (int j = 0; j < n; ++j) {
        if (i == j || !end.origin) continue;
        const BoundingVolumeHierarchy::Nearest near = trees[j]->nearest(end.p, longest_gap_m + 2 * end.radius_m);
        if (near.triangle < 0) continue;
        const double gap = near.distance_m - end.radius_m;
        if (gap > longest_gap_m) continue;
        const Eigen::Vector3d towards = (near.point - end.p).normalized();
        const double radius_there = radius_at(lines[j], near.point);
        Candidate candidate{{i, j, end.p, near.point, end.radius_m, std::max(0.0, gap), false}, false};
        candidate.bridge.leaving = end.outwards;
        candidate.bridge.arriving = (towards - outward_normal(lumens[j], near.triangle)).normalized();
        candidate.to_wider = radius_there > much_wider * end.radius_m;
        if (candidate.to_wider) candidate.bridge.radius_m = end.widest_m;  // an ostium is not narrower than its vessel
        const VesselEnd* other = nullptr;
        for (const VesselEnd& o : ends[j])
          if ((o.p - near.point).norm() < 2 * o.radius_m &&
              (!other || (o.p - near.point).norm() < (other->p - near.point).norm()))
            other = &o;
        // Go straight ahead, unless that is much farther.
        if (const auto ahead = trees[j]->hits(end.p, end.outwards, near.distance_m * 1.5); !ahead.empty()) {
          candidate.bridge.p_to = end.p + ahead[0].distance_m * end.outwards;
          candidate.bridge.arriving = end.outwards;
        }
        // Origins that stop short are drawn in any direction.
        if (towards.dot(end.outwards) < (candidate.to_wider ? -facing_cosine : facing_cosine)) continue;
        if (!candidate.to_wider) {
          if (other) {
            const double ratio = other->radius_m / end.radius_m;
            if (ratio > like || ratio < 1 / like || other->outwards.dot(end.outwards) > -end_to_end_cosine) continue;
            candidate.bridge.to_end = true;
            candidate.bridge.p_to = other->p;
            candidate.bridge.arriving = -other->outwards;
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
  constexpr int columns = 24, pieces = 12;
  // Share of the length that runs straight: a third, more if the end points elsewhere, so that the bend is wide.
  const auto handle = [](double cosine) { return 1.0 / 3 + 0.6 * (1 - cosine) / 2; };
  const Eigen::Vector3d way = bridge.p_to - bridge.p_from, straight = way.normalized();
  const Eigen::Vector3d leaving = bridge.leaving.isZero() ? straight : bridge.leaving;
  const Eigen::Vector3d arriving = bridge.arriving.isZero() ? straight : bridge.arriving;
  const Eigen::Vector3d b1 = bridge.p_from + handle(leaving.dot(straight)) * way.norm() * leaving,
                        b2 = bridge.p_to - handle(arriving.dot(straight)) * way.norm() * arriving;
  std::vector<Eigen::Vector3d> line = {bridge.p_from - reach_m * leaving}, along = {leaving};
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces, r = 1 - t;
    line.push_back(r * r * r * bridge.p_from + 3 * r * r * t * b1 + 3 * r * t * t * b2 + t * t * t * bridge.p_to);
    along.push_back((r * r * (b1 - bridge.p_from) + 2 * r * t * (b2 - b1) + t * t * (bridge.p_to - b2)).normalized());
  }
  line.push_back(bridge.p_to + reach_m * arriving);
  along.push_back(arriving);
  const int rings = static_cast<int>(line.size());
  Mesh mesh;
  Eigen::Vector3d x = along[0].unitOrthogonal();
  for (int i = 0; i < rings; ++i) {
    x = (x - x.dot(along[i]) * along[i]).normalized();  // parallel transport
    const Eigen::Vector3d y = along[i].cross(x);
    for (int k = 0; k < columns; ++k) {
      const double angle = 2 * units::pi * k / columns;
      mesh.vertices.push_back(line[i] + bridge.radius_m * (std::cos(angle) * x + std::sin(angle) * y));
    }
  }
  mesh.vertices.push_back(line.front());
  mesh.vertices.push_back(line.back());
  for (int k = 0; k < columns; ++k) {
    const int next = (k + 1) % columns, last = (rings - 1) * columns;
    for (int ring = 0; ring < last; ring += columns) {
      mesh.triangles.push_back({ring + k, ring + next, ring + columns + k});
      mesh.triangles.push_back({ring + next, ring + columns + next, ring + columns + k});
    }
    mesh.triangles.push_back({rings * columns, next, k});
    mesh.triangles.push_back({rings * columns + 1, last + k, last + next});
  }
  return mesh;
}

}  // namespace ostium::vascular
