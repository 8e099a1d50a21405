#include "vascular/treatment/stent_ties.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

namespace {

constexpr double searched_m = 3e-3;  ///< beyond a ring and the vessel's radius
constexpr double moved_m = 0.1e-3;   ///< that a point may go until its ring is tied anew

/// The cell that a triangle belongs to: that of its first corner in a coronary artery; -1 in the aorta.
int cell_of(const LumenMap& map, const std::array<int, 3>& triangle) {
  for (const int corner : triangle)
    if (const VertexSource& from = map.sources[static_cast<std::size_t>(corner)].first;
        from.part == VertexSource::coronary)
      return from.below;
  return -1;
}

/// A point of a ring, and how near the wall is as seen so far.
struct RingPoint {
  Eigen::Vector3d point;
  double distance_m = 1;
};

/// Barycentric weights of b and c at a point of the triangle's plane.
std::pair<double, double> weights_at(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     const Eigen::Vector3d& c) {
  const Eigen::Vector3d u = b - a, v = c - a, w = p - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v), d = uu * vv - uv * uv;
  if (!(d > 0)) return {0, 0};
  return {(vv * wu - uv * wv) / d, (uu * wv - uv * wu) / d};
}

/// The first point of the ring that is tied next: one that is not, else one whose points have moved since; -1: none.
int next_ring(const StentModel& m, const StentState& s) {
  const int around = 2 * m.crowns;
  for (int begin = 0; begin < m.points(); begin += around)
    if (s.ties[static_cast<std::size_t>(begin)].triangle == StentTie::untied) return begin;
  for (int i = 0; i < m.points(); ++i) {
    const StentTie& tie = s.ties[static_cast<std::size_t>(i)];
    const double along_m = s.along_m[i] + s.pushed_m[i] - tie.along_m,
                 round_m = s.radius_m[i / around] * (s.turned_rad[i] - tie.turned_rad);
    if (std::hypot(along_m, round_m) > moved_m) return i / around * around;
  }
  return -1;
}

}  // namespace

StentTies::StentTies(const Patient& patient, const WallShape& shape, const LumenMap& map, const FlowTree& tree)
    : patient_(patient), shape_(shape), map_(map), first_(tree.cells.size() + 1, 0) {
  const auto& all = patient.lumen.triangles;
  for (const auto& triangle : all)
    if (const int cell = cell_of(map, triangle); cell >= 0) ++first_[static_cast<std::size_t>(cell) + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  triangles_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < all.size(); ++t)
    if (const int cell = cell_of(map, all[t]); cell >= 0)
      triangles_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell)]++)] = static_cast<int>(t);
}

bool StentTies::tie_next(const StentModel& m, const VesselPath& path, const PlaqueState& wall,
                         const LumenMoment& moment, StentState& s) const {
  const int around = 2 * m.crowns;
  const int begin = next_ring(m, s);
  if (begin < 0) return false;
  double least_m = place_of_m(s, begin);
  for (int j = 1; j < around; ++j) least_m = std::min(least_m, place_of_m(s, begin + j));
  const PathFrames frames(map_, path, least_m, moment);
  std::array<RingPoint, 2 * most_crowns> ring;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int j = 0; j < around; ++j) {
    ring[j].point = point_on_path(m, s, frames, begin + j);
    middle += ring[j].point / around;
  }
  const double near_m = s.radius_m[begin / around] + searched_m;
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    if ((map_.centre(cell, moment) - middle).norm() > near_m + wall.radius_m[cell]) continue;
    for (int k = first_[cell]; k < first_[cell + 1]; ++k) {
      const auto& triangle = patient_.lumen.triangles[static_cast<std::size_t>(triangles_[k])];
      const auto corner = [&](int n) {
        return shape_.vertex(static_cast<std::size_t>(triangle[n]), wall.radius_m, moment);
      };
      const Eigen::Vector3d a = corner(0);
      if ((a - middle).norm() > near_m) continue;
      const Eigen::Vector3d b = corner(1), c = corner(2);
      const double size_m = std::sqrt(std::max((b - a).squaredNorm(), (c - a).squaredNorm()));
      for (int j = 0; j < around; ++j) {
        RingPoint& best = ring[j];
        if ((best.point - a).squaredNorm() > (best.distance_m + size_m) * (best.distance_m + size_m)) continue;
        const Eigen::Vector3d q = nearest_on_triangle(best.point, a, b, c);
        const double distance_m = (q - best.point).norm();
        if (distance_m >= best.distance_m) continue;
        const auto [u, v] = weights_at(q, a, b, c);
        best.distance_m = distance_m;
        s.ties[static_cast<std::size_t>(begin + j)] = {triangles_[k], u, v};
      }
    }
  }
  for (int j = 0; j < around; ++j) {
    StentTie& tie = s.ties[static_cast<std::size_t>(begin + j)];
    if (tie.triangle == StentTie::untied) tie.triangle = StentTie::out_of_reach;
    tie.depth_m = m.strut_m / 2 + gap_of(m, s, path, wall, begin + j);
    tie.along_m = s.along_m[begin + j] + s.pushed_m[begin + j], tie.turned_rad = s.turned_rad[begin + j];
  }
  return true;
}

void tie_to_wall(const StentTies& ties, const StentModel& model, const VesselPath& path, const PlaqueState& wall,
                 const LumenMoment& moment, StentState& state) {
  std::fill(state.ties.begin(), state.ties.end(), StentTie{});
  while (ties.tie_next(model, path, wall, moment, state)) {
  }
}

}  // namespace ostium::vascular
