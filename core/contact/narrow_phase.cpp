#include "core/contact/narrow_phase.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"

namespace ostium::core {

namespace {

constexpr double rounding_share = 1e-6;  ///< rounding margin of the single-precision test, per extent

bool is_at_rim(const TrianglePoint& w) { return !(w.u > 0 && w.v > 0 && w.u + w.v < 1); }

/// Outward direction at the rim of a soft wall's triangle: the normals of the surrounding triangles, averaged. A node
/// pressed in is behind all of them (join_soft_walls).
V3<double> rim_outward(const Surface& surface, const Surface::Cluster& c, const Surface::Triangle& t,
                       const TrianglePoint& w) {
  const auto corner = [&](int k) {
    const V3<float>& n = surface.corner_normals[c.first_corner + t.corner[k]];
    return V3<double>{n.x, n.y, n.z};
  };
  return madd(w.v, corner(2), madd(w.u, corner(1), (1 - w.u - w.v) * corner(0)));
}

/// Unit vector around the instrument; zero where it meets the wall head on.
V3<double> across(const NodeView& view, const V3<double>& normal) {
  const V3<double> e = cross(view.tangent, normal);
  const double length = norm(e);
  return length > 1e-3 ? (1 / length) * e : V3<double>{};
}

/// Distance from a wall, in front or behind: a node pressed into a soft wall may have its centre behind it.
double away(const WallPlane& plane) { return std::fabs(plane.gap); }

/// Whether a wall farther than the nearest is seen from behind. Only the nearest piece of wall tells which side a point
/// is on: behind a ridge, a wall faces away from a node that is in the lumen all the same. Soft walls are exempt
/// (join_soft_walls).
bool turns_its_back(double gap, bool soft) { return !soft && gap < 0; }

/// Of a full list's planes and a new one at `at`, sorted by distance, the one to leave out: the farthest. But in a
/// passage as narrow as the node, walls face each other, and the nearest may all lie on one side, so that the node
/// would evade through the other: there, of the two that face most alike, the farther.
int least_needed(const NodeWalls& walls, const V3<double>& normal, int at) {
  std::array<V3<double>, max_planes + 1> faces;
  for (int k = 0; k < max_planes; ++k) faces[k < at ? k : k + 1] = walls.planes[k].normal;
  faces[at] = normal;
  int least = max_planes;
  double most_alike = -1;
  bool enclosed = false;
  for (int k = 1; k <= max_planes; ++k)
    for (int j = 0; j < k; ++j) {
      const double alike = dot(faces[k], faces[j]);
      enclosed = enclosed || alike < -tolerances::same_side;
      if (alike > most_alike) most_alike = alike, least = k;
    }
  return enclosed ? least : max_planes;
}

/// Whether a triangle is seen from behind across its rim. Another one that meets it there may be seen from the front.
bool is_doubtful(const WallPlane& w) { return w.gap < 0 && w.facing < 1; }
bool is_doubtful(const SeenTriangle& sight) { return sight.gap < 0 && sight.facing < 1; }

/// At a ridge, triangles whose nearest point is the same may disagree on the node's side. The one that faces it most
/// squarely is right (at an edge: the node lies between the two faces' normals, less than pi apart). False if that is
/// one that is listed; else it is removed.
bool faces_more_squarely(const SeenTriangle& sight, NodeWalls& walls) {
  for (int k = 0; k < walls.count; ++k) {
    WallPlane& w = walls.planes[k];
    if (norm(w.gap * w.normal - sight.gap * sight.normal) > tolerances::same_point_m) continue;
    if (w.gap * sight.gap > 0) {
      w.facing = largest(w.facing, sight.facing);  // it stands for both
      continue;
    }
    if (w.facing >= sight.facing) return false;
    std::copy(walls.planes + k + 1, walls.planes + walls.count, walls.planes + k);
    --walls.count;
    return true;
  }
  return true;
}

/// Makes room among a node's planes, sorted by distance, at most one per direction. Index of the new one; -1 if it is
/// not needed.
int make_room(const SeenTriangle& sight, bool soft, NodeWalls& walls) {
  if (!soft && !faces_more_squarely(sight, walls)) return -1;
  const bool doubtful = is_doubtful(sight);
  const auto as_it_faces = [&](const WallPlane& w) {
    return doubtful == is_doubtful(w) && dot(w.normal, sight.normal) > tolerances::same_wall;
  };
  WallPlane* const planes = walls.planes;
  int at = walls.count;
  while (at > 0 && away(planes[at - 1]) > std::fabs(sight.gap)) --at;
  if (at > 0 && turns_its_back(sight.gap, soft)) return -1;
  if (std::any_of(planes, planes + at, as_it_faces)) return -1;
  // It replaces farther planes with the same direction.
  const WallPlane* end = std::remove_if(planes + at, planes + walls.count, [&](const WallPlane& w) {
    return turns_its_back(w.gap, w.soft) || as_it_faces(w);
  });
  walls.count = static_cast<int>(end - planes);
  if (walls.count == max_planes) {
    // The nearest planes of a soft wall push as one (join_soft_walls).
    const int spare = soft ? max_planes : least_needed(walls, sight.normal, at);
    if (spare == at) return -1;
    const int gone = spare < at ? spare : spare - 1;
    std::copy(planes + gone + 1, planes + walls.count, planes + gone);
    --walls.count;
    if (spare < at) --at;
  }
  std::copy_backward(planes + at, planes + walls.count, planes + walls.count + 1);
  ++walls.count;
  return at;
}

bool any_soft(const NodeWalls& walls) {
  return std::any_of(walls.planes, walls.planes + walls.count, [](const WallPlane& w) { return w.soft; });
}

/// A node pressed into a soft wall is also behind the neighbours of the nearest triangle. If each of them pushed, the
/// wall would be that many times stiffer; if only the nearest did, the force would jump where two triangles meet. So
/// they push as one plane, weighted by how close each is to being the nearest.
void join_soft_walls(const NodeView& view, NodeWalls& walls) {
  int count = 0;
  for (int k = 0; k < walls.count; ++k) {
    WallPlane& w = walls.planes[k];
    const auto known = [&](const WallPlane& other) { return one_soft_wall(other, w); };
    if (std::any_of(walls.planes, walls.planes + count, known)) continue;
    if (w.soft) {  // the nearest, since planes are sorted
      double weight = 0, depth = 0, gap = 0;
      V3<double> normal{}, carried{};
      for (int j = k; j < walls.count; ++j) {
        const WallPlane& other = walls.planes[j];
        const double share = 1 - (away(other) - away(w)) / tolerances::joined_m;
        if (share <= 0 || (j > k && !one_soft_wall(w, other))) continue;
        weight += share, gap += share * other.gap;
        depth += share * (other.place - dot(other.normal, view.centre));
        normal = madd(share, other.normal, normal), carried = madd(share, other.carried, carried);
      }
      w.normal = (1 / norm(normal)) * normal;
      w.gap = gap / weight, w.carried = (1 / weight) * carried;
      w.place = dot(w.normal, view.centre) + depth / weight;
      w.across = across(view, w.normal);
    }
    walls.planes[count++] = w;
  }
  walls.count = count;
}

/// Which of a cluster's triangles may be within reach, one bit each: both its bounding ball and its plane must be.
unsigned may_meet(const ClusterPose& pose, StepEnd end, int triangles, const NodeView& view) {
  // At the end of the step, seen as if the wall had stayed.
  const bool before = end == StepEnd::before;
  const V3<double> from = view.centre - pose.low - (before ? V3<double>{} : pose.move.drift),
                   size = pose.high - pose.low;
  const double reach = view.reach + (before ? 0 : pose.move.spread);
  const auto all = [](double a) { return _mm256_set1_ps(static_cast<float>(a)); };
  const __m256 x = all(from.x), y = all(from.y), z = all(from.z),
               near = all(reach + rounding_share * (size.x + size.y + size.z + reach));
  const TriangleBounds& t = pose.bounds;
  unsigned any = 0;
  for (int k = 0; k < triangles; k += 8) {
    const auto at = [k](const float* p) { return _mm256_loadu_ps(p + k); };
    const __m256 dx = x - at(t.x), dy = y - at(t.y), dz = z - at(t.z), within = near + at(t.radius);
    const __m256 height = at(t.normal_x) * x + at(t.normal_y) * y + at(t.normal_z) * z - at(t.height);
    const __m256 both = _mm256_and_ps(_mm256_cmp_ps(dx * dx + dy * dy + dz * dz, within * within, _CMP_LE_OQ),
                                      _mm256_cmp_ps(height * height, near * near, _CMP_LE_OQ));
    any |= static_cast<unsigned>(_mm256_movemask_ps(both)) << k;
  }
  return any & ((1U << triangles) - 1);
}

/// Removes walls that the node's centre is behind, except the nearest (a soft wall may have the centre behind it).
void drop_walls_seen_from_behind(NodeWalls& walls) {
  int own = 0, count = 0;
  for (int k = 1; k < walls.count; ++k)
    if (std::fabs(walls.planes[k].gap) < std::fabs(walls.planes[own].gap)) own = k;
  for (int k = 0; k < walls.count; ++k)
    if (k == own || walls.planes[k].gap > 0) walls.planes[count++] = walls.planes[k];
  walls.count = count;
}

V3<double> tangent_at(const Rod& rod, const RodState& state, int i) {
  const V3<double> t = director3(load4<double>(state.orientation, std::max(i - 1, rod.first))) +
                       director3(load4<double>(state.orientation, std::min(i, rod.elements - 1)));
  return (1 / norm(t)) * t;
}

}  // namespace

NodeView view_of(const Rod& rod, const RodState& state, int i, const V3<double>& centre, double travel) {
  const double radius = rod.radius.at(0)[i];
  return {centre, radius, radius + travel, tangent_at(rod, state, i), rod.joint_length.at(0)[i]};
}

WallPlane plane_of(const Surface& surface, const NodeView& view, const V3<double>& normal, double gap,
                   const Foot& foot) {
  WallPlane plane;
  plane.gap = gap;
  plane.normal = normal;
  plane.place = dot(normal, foot.after) + view.radius;
  plane.carried = foot.after - foot.before;
  plane.friction = surface.friction;
  plane.soft = surface.stiffness_N_m2 > 0;
  plane.softness = 1 / (view.cell * (plane.soft ? surface.stiffness_N_m2 : tolerances::wall_N_m2));
  plane.across = across(view, normal);
  return plane;
}

bool see(const Surface& surface, const Surface::Cluster& c, const Surface::Triangle& t, const Field<3>& now,
         const NodeView& view, SeenTriangle& sight) {
  const V3<double> a = load3<double>(now, t.corner[0]), b = load3<double>(now, t.corner[1]),
                   d = load3<double>(now, t.corner[2]);
  const V3<double> out = cross(b - a, d - a);
  const double height = dot(view.centre - a, out), area2 = dot(out, out);
  if (height * height > view.reach * view.reach * area2 || !(area2 > 0)) return false;
  sight.point = nearest(view.centre, a, b, d);
  sight.foot = at(sight.point, a, b, d);
  const V3<double> away = view.centre - sight.foot;
  const double apart = norm(away);
  if (apart > view.reach) return false;
  sight.at_rim = is_at_rim(sight.point);
  const bool soft = surface.stiffness_N_m2 > 0;
  const double along = dot(away, soft && sight.at_rim ? rim_outward(surface, c, t, sight.point) : out);
  sight.gap = along > 0 ? -apart : apart;
  sight.normal = apart > 1e-9 ? (1 / sight.gap) * away : (-1 / std::sqrt(area2)) * out;
  sight.facing = !soft && sight.at_rim && apart > 1e-9 ? std::fabs(along) / (apart * std::sqrt(area2)) : 1;
  return true;
}

bool see_again(const Surface& surface, const WallPlane& was, const Field<3>& now, const NodeView& view,
               SeenTriangle& sight) {
  if (!see(surface, surface.clusters[was.cluster], surface.triangles[was.triangle], now, view, sight)) return false;
  if (sight.at_rim && was.gap * sight.gap < 0) sight.gap = -sight.gap, sight.normal = -1.0 * sight.normal;
  return true;
}

WallPlane plane_of(const Surface& surface, const NodeView& view, const Surface::Triangle& t, const ClusterPose& pose,
                   const Field<3>& now, const SeenTriangle& sight) {
  const auto corner = [&](const Field<3>& corners, int k) { return load3<double>(corners, t.corner[k]); };
  const auto moment = [&](const Field<3>& corners) {
    return at(sight.point, corner(corners, 0), corner(corners, 1), corner(corners, 2));
  };
  WallPlane plane =
      plane_of(surface, view, sight.normal, sight.gap, {sight.foot, moment(pose.before), moment(pose.after)});
  const double bend = curvature_towards(plane.across, t, corner(now, 0), corner(now, 1), corner(now, 2));
  if (bend > 0) plane.curvature = least(1 / largest(1 / bend - view.radius, 1e-9), tolerances::most_curved_wall_per_m);
  return plane;
}

void look(const Model& model, int at_surface, int cluster, const ClusterPose& pose, StepEnd end, const NodeView& view,
          bool passes, NodeWalls& walls) {
  const Field<3>& now = end == StepEnd::before ? pose.before : pose.after;
  const Surface& surface = *model.surfaces[at_surface];
  const Surface::Cluster& c = surface.clusters[cluster];
  for (unsigned left = may_meet(pose, end, c.triangles, view); left != 0; left &= left - 1) {
    const int triangle = c.first_triangle + std::countr_zero(left);
    const Surface::Triangle& t = surface.triangles[triangle];
    SeenTriangle sight;
    if ((passes && t.door) || !see(surface, c, t, now, view, sight)) continue;
    // Of a ridge farther away, only one of its faces may be within reach, as each cluster's reach differs.
    if (is_doubtful(sight) && -sight.gap > view.radius + tolerances::wall_slack_m) continue;
    const int place = make_room(sight, surface.stiffness_N_m2 > 0, walls);
    if (place < 0) continue;
    WallPlane& plane = walls.planes[place];
    plane = plane_of(surface, view, t, pose, now, sight);
    plane.facing = sight.facing;
    if (sight.at_rim && !plane.soft) plane.surface = at_surface, plane.cluster = cluster, plane.triangle = triangle;
  }
}

double least_distance(const ClusterPose& pose, int triangles, const V3<double>& p) {
  const V3<double> from = p - pose.low, size = pose.high - pose.low;
  const auto all = [](double a) { return _mm256_set1_ps(static_cast<float>(a)); };
  const __m256 x = all(from.x), y = all(from.y), z = all(from.z), sign = _mm256_set1_ps(-0.0F), none = all(1),
               lane = _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
  const TriangleBounds& t = pose.bounds;
  __m256 least_of = none;
  for (int k = 0; k < triangles; k += 8) {
    const auto at = [k](const float* bound) { return _mm256_loadu_ps(bound + k); };
    const __m256 dx = x - at(t.x), dy = y - at(t.y), dz = z - at(t.z);
    const __m256 ball = _mm256_sqrt_ps(dx * dx + dy * dy + dz * dz) - at(t.radius);
    const __m256 height = at(t.normal_x) * x + at(t.normal_y) * y + at(t.normal_z) * z - at(t.height);
    const __m256 apart = _mm256_max_ps(ball, _mm256_andnot_ps(sign, height));
    least_of =
        _mm256_min_ps(least_of, _mm256_blendv_ps(none, apart, _mm256_cmp_ps(lane, all(triangles - k), _CMP_LT_OQ)));
  }
  float each[8];
  _mm256_storeu_ps(each, least_of);
  const double apart = *std::min_element(each, each + 8);
  return apart - rounding_share * (size.x + size.y + size.z + std::fabs(apart) + norm(from));
}

void sum_up(const NodeView& view, NodeWalls& walls) {
  if (any_soft(walls)) join_soft_walls(view, walls);
  drop_walls_seen_from_behind(walls);
}

bool one_soft_wall(const WallPlane& a, const WallPlane& b) {
  return a.soft && b.soft && dot(a.normal, b.normal) > tolerances::same_soft_wall;
}

bool lets_through(const Surface& surface, const SurfacePose& whole, double radius) {
  return whole.door_open && radius <= surface.door_passes_m;
}

}  // namespace ostium::core
