/// Which walls a node can reach.
#include "core/contact/walls.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/contact/contact.h"
#include "core/math/rotation.h"
#include "core/surface/triangle.h"
#include "core/tunables.h"

namespace ostium {

namespace {

constexpr int block = 8;             ///< nodes that share a query
constexpr double rounding_m = 1e-9;  ///< what a coarse look allows for, before an exact one

double norm(const V3<double>& v) { return std::sqrt(dot(v, v)); }

/// Where a ball is seen from a wall: at one of both ends of the step.
struct View {
  V3<double> centre;
  double radius, reach;
  V3<double> tangent;  ///< of the rod
  double cell;         ///< m, length of rod that the node stands for
};

/// A point of a triangle, at both ends of the step.
struct Foot {
  V3<double> now, before, after;
};

bool is_at_rim(const TrianglePoint& w) { return !(w.u > 0 && w.v > 0 && w.u + w.v < 1); }

/// Which side a triangle's rim faces: inside it its own normal tells, at the rim the mean of those around.
V3<double> rim_outward(const Surface& surface, const Surface::Cluster& c, const Surface::Triangle& t,
                       const TrianglePoint& w) {
  const auto corner = [&](int k) {
    const V3<float>& n = surface.corner_normals[c.first_corner + t.corner[k]];
    return V3<double>{n.x, n.y, n.z};
  };
  return madd(w.v, corner(2), madd(w.u, corner(1), (1 - w.u - w.v) * corner(0)));
}

/// Round the instrument; zero where the wall is met head on.
V3<double> across(const View& view, const V3<double>& normal) {
  const V3<double> e = cross(view.tangent, normal);
  const double length = norm(e);
  return length > 1e-3 ? (1 / length) * e : V3<double>{};
}

WallPlane plane_of(const Surface& surface, const View& view, const V3<double>& normal, double gap, const Foot& foot) {
  WallPlane plane;
  plane.gap = gap;
  plane.normal = normal;
  plane.place = dot(normal, foot.after) + view.radius;
  plane.carried = foot.after - foot.before;
  plane.friction = surface.friction;
  plane.soft = surface.stiffness_N_m2 > 0;
  plane.softness = 1 / (view.cell * (plane.soft ? surface.stiffness_N_m2 : tunables::wall_N_m2));
  plane.across = across(view, normal);
  return plane;
}

/// Behind a wall or not: what is pressed into one that gives way may have its centre behind it.
double away(const WallPlane& plane) { return std::fabs(plane.gap); }

/// Whether a wall beside a nearer one is seen from behind. On which side of it a point lies, only the nearest piece of
/// wall tells: what lies round a ridge turns its back to a node that is in the lumen all the same. Of a wall that gives
/// way they may all be (join_soft_walls).
bool turns_its_back(const WallPlane& plane) { return !plane.soft && plane.gap < 0; }

/// Keeps the planes of one node: the nearest, and those that face elsewhere.
void keep(const WallPlane& plane, NodeWalls& walls) {
  int at = walls.count;
  while (at > 0 && away(walls.planes[at - 1]) > away(plane)) --at;
  if (at > 0 && turns_its_back(plane)) return;
  for (int k = 0; k < at; ++k)
    if (dot(walls.planes[k].normal, plane.normal) > tunables::same_wall) return;
  // It stands for those further away that face as it does.
  WallPlane behind[max_planes];
  const int others = walls.count - at;
  std::copy(walls.planes + at, walls.planes + walls.count, behind);
  walls.count = at;
  if (walls.count < max_planes) walls.planes[walls.count++] = plane;
  for (int k = 0; k < others && walls.count < max_planes; ++k)
    if (!turns_its_back(behind[k]) && dot(behind[k].normal, plane.normal) <= tunables::same_wall)
      walls.planes[walls.count++] = behind[k];
}

bool any_soft(const NodeWalls& walls) {
  return std::any_of(walls.planes, walls.planes + walls.count, [](const WallPlane& w) { return w.soft; });
}

/// Whether two planes are parts of one wall that gives way.
bool one_soft_wall(const WallPlane& a, const WallPlane& b) {
  return a.soft && b.soft && dot(a.normal, b.normal) > tunables::same_soft_wall;
}

/// What is pressed into a wall that gives way lies behind the nearest triangle's neighbours too, sideways of it. If
/// each of them pushed, the wall would be as many times as stiff; if the nearest did alone, its push would leap from
/// one side to the other where two meet. They push as one, those that are about as near as the nearest by so much the
/// more.
void join_soft_walls(const View& view, NodeWalls& walls) {
  int count = 0;
  for (int k = 0; k < walls.count; ++k) {
    WallPlane& w = walls.planes[k];
    const auto known = [&](const WallPlane& other) { return one_soft_wall(other, w); };
    if (std::any_of(walls.planes, walls.planes + count, known)) continue;
    if (w.soft) {  // the nearest, as they are sorted
      double weight = 0, depth = 0, gap = 0;
      V3<double> normal{}, carried{};
      for (int j = k; j < walls.count; ++j) {
        const WallPlane& other = walls.planes[j];
        const double share = 1 - (away(other) - away(w)) / tunables::joined_m;
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

/// Which of a cluster's triangles may be within reach, a bit for each.
unsigned may_meet(const ClusterPose& pose, const View& view) {
  const V3<Lanes> centre{Lanes{} + view.centre.x, Lanes{} + view.centre.y, Lanes{} + view.centre.z};
  const Lanes reach = Lanes{} + (view.reach + rounding_m);
  unsigned any = 0;
  for (int k = 0; k < pose.balls.size(); k += lane_count) {
    const Q4<Lanes> ball = load4<Lanes>(pose.balls, k);
    const V3<Lanes> away = centre - V3<Lanes>{ball.w, ball.x, ball.y};
    const Lanes within = reach + ball.z;
    any |= static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(dot(away, away), within * within, _CMP_LE_OQ))) << k;
  }
  return any & ((1U << pose.balls.size()) - 1);
}

/// Whether a door lets a node of that radius through.
bool lets_through(const Surface& surface, const SurfacePose& whole, double radius) {
  return whole.door_open && radius <= surface.door_passes_m;
}

/// A triangle as a plane, by the point of it that is nearest; false if that is out of reach. `at_rim`: where it is.
bool see(const Surface& surface, const Surface::Cluster& c, const Surface::Triangle& t, const ClusterPose& pose,
         const Field<3>& now, const View& view, WallPlane& plane, bool& at_rim) {
  const V3<double> a = load3<double>(now, t.corner[0]), b = load3<double>(now, t.corner[1]),
                   d = load3<double>(now, t.corner[2]);
  const V3<double> out = cross(b - a, d - a);
  const double height = dot(view.centre - a, out), area2 = dot(out, out);
  if (height * height > view.reach * view.reach * area2 || !(area2 > 0)) return false;
  const TrianglePoint w = nearest(view.centre, a, b, d);
  const V3<double> foot = at(w, a, b, d), away = view.centre - foot;
  const double apart = norm(away);
  if (apart > view.reach) return false;
  at_rim = is_at_rim(w);
  const bool behind = dot(away, at_rim ? rim_outward(surface, c, t, w) : out) > 0;
  const double gap = behind ? -apart : apart;
  const V3<double> normal = apart > 1e-9 ? (1 / gap) * away : (-1 / std::sqrt(area2)) * out;
  const auto moment = [&](const Field<3>& corners) {
    return at(w, load3<double>(corners, t.corner[0]), load3<double>(corners, t.corner[1]),
              load3<double>(corners, t.corner[2]));
  };
  plane = plane_of(surface, view, normal, gap, {foot, moment(pose.before), moment(pose.after)});
  const double bend = curvature_towards(plane.across, t, a, b, d);
  if (bend > 0) plane.curvature = least(1 / largest(1 / bend - view.radius, 1e-9), tunables::most_curved_wall_per_m);
  return true;
}

/// Adds what of a cluster is within reach, seen with the corners `now`; `passes`: but for its door.
void look(const Model& model, int at_surface, int cluster, const ClusterPose& pose, const Field<3>& now,
          const View& view, bool passes, NodeWalls& walls) {
  const Surface& surface = *model.surfaces[at_surface];
  const Surface::Cluster& c = surface.clusters[cluster];
  for (unsigned left = may_meet(pose, view); left != 0; left &= left - 1) {
    const int triangle = c.first_triangle + std::countr_zero(left);
    const Surface::Triangle& t = surface.triangles[triangle];
    WallPlane plane;
    bool at_rim;
    if ((passes && t.door) || !see(surface, c, t, pose, now, view, plane, at_rim)) continue;
    if (at_rim && !plane.soft) plane.surface = at_surface, plane.cluster = cluster, plane.triangle = triangle;
    keep(plane, walls);
  }
}

V3<double> tangent_at(const Rod& rod, const RodState& state, int i) {
  const V3<double> t = director3(load4<double>(state.orientation, std::max(i - 1, rod.first))) +
                       director3(load4<double>(state.orientation, std::min(i, rod.elements - 1)));
  return (1 / norm(t)) * t;
}

View view_of(const Rod& rod, const RodState& state, int i, const V3<double>& centre, double travel) {
  const double radius = rod.radius.at(0)[i];
  return {centre, radius, radius + travel, tangent_at(rod, state, i), rod.joint_length.at(0)[i]};
}

/// Sees a wall anew from `to`, as it is at the end of the step. False: what it is from there, another is already.
bool is_in_the_way(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch,
                   WallPlane& wall) {
  const Surface& surface = *model.surfaces[wall.surface];
  const ClusterPose& pose = pose_of(surface, wall.cluster, scratch.surfaces[wall.surface]);
  View view = view_of(strand.s->inside, *strand.own, i, to, 0);
  view.reach *= 2;
  WallPlane seen;
  bool at_rim;
  if (!see(surface, surface.clusters[wall.cluster], surface.triangles[wall.triangle], pose, pose.after, view, seen,
           at_rim) ||
      dot(seen.normal, wall.normal) < tunables::same_side)
    return true;
  const NodeWalls& walls = strand.contact->walls[i];
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& other = walls.planes[k];
    if (&other != &wall && dot(other.normal, seen.normal) > tunables::same_wall &&
        other.place - dot(other.normal, to) > seen.place - dot(seen.normal, to) - tunables::wall_loose_m)
      return false;
  }
  seen.gap = wall.gap;
  seen.surface = wall.surface, seen.cluster = wall.cluster, seen.triangle = wall.triangle;
  wall = seen;
  return true;
}

/// The nodes of a query, side by side; a place without a node reaches nothing.
struct Block {
  double x[block], y[block], z[block], reach[block];

  void set(int at, const V3<double>& p, double how_far) { x[at] = p.x, y[at] = p.y, z[at] = p.z, reach[at] = how_far; }
  /// Which of them a box may be in reach of, that moves by `move`: a bit for each.
  unsigned near(const V3<double>& low, const V3<double>& high, double move) const {
    const auto outside = [](Lanes p, double a, double b) { return largest(Lanes{}, largest(a - p, p - b)); };
    unsigned any = 0;
    for (int k = 0; k < block; k += lane_count) {
      const V3<Lanes> away{outside(load<Lanes>(x + k), low.x, high.x), outside(load<Lanes>(y + k), low.y, high.y),
                           outside(load<Lanes>(z + k), low.z, high.z)};
      const Lanes far = load<Lanes>(reach + k) + (move + rounding_m);
      const Lanes within =
          _mm256_and_pd(_mm256_cmp_pd(dot(away, away), far * far, _CMP_LE_OQ), _mm256_cmp_pd(far, Lanes{}, _CMP_GT_OQ));
      any |= static_cast<unsigned>(_mm256_movemask_pd(within)) << k;
    }
    return any;
  }
};

/// Walls that the node's centre is behind do not hold it, unless it is its own that gives way: the nearest.
void drop_walls_seen_from_behind(NodeWalls& walls) {
  int own = 0, count = 0;
  for (int k = 1; k < walls.count; ++k)
    if (std::fabs(walls.planes[k].gap) < std::fabs(walls.planes[own].gap)) own = k;
  for (int k = 0; k < walls.count; ++k)
    if (k == own || walls.planes[k].gap > 0) walls.planes[count++] = walls.planes[k];
  walls.count = count;
}

/// Lets go of walls that the way from `from` to `to` passes although nothing is met on it: a wall ends at a ridge, its
/// plane does not, and two sides of a ridge would hold a node in the solid between them. True if one of them held it.
bool drop_passed_walls(const V3<double>& from, const V3<double>& to, double radius, NodeWalls& walls) {
  bool any = false;
  int count = 0;
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& w = walls.planes[k];
    const double surface = w.place - radius;
    if (dot(w.normal, from) >= surface && dot(w.normal, to) < surface - tunables::passed_wall_m)
      any = any || w.active;
    else
      walls.planes[count++] = w;
  }
  walls.count = count;
  return any;
}

struct Bounds {
  V3<double> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  void take(const V3<double>& p, double reach) {
    low = {least(low.x, p.x - reach), least(low.y, p.y - reach), least(low.z, p.z - reach)};
    high = {largest(high.x, p.x + reach), largest(high.y, p.y + reach), largest(high.z, p.z + reach)};
  }
};

/// The first triangle that the path leaves the lumen through, as a plane, and where; seen with the corners of the
/// step's end.
bool first_exit(const Model& model, const V3<double>& from, const V3<double>& to, View view, Scratch& scratch,
                std::vector<int>& clusters, WallPlane& exit, V3<double>& at) {
  double first = 2;
  Bounds bounds;
  bounds.take(from, 0), bounds.take(to, 0);
  for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
    const Surface& surface = *model.surfaces[k];
    const bool passes = lets_through(surface, scratch.surfaces[k], view.radius);
    find_clusters(surface, bounds.low, bounds.high, scratch.surfaces[k], clusters);
    for (int cluster : clusters) {
      const ClusterPose& pose = pose_of(surface, cluster, scratch.surfaces[k]);
      const Surface::Cluster& c = surface.clusters[cluster];
      for (int j = c.first_triangle; j < c.first_triangle + c.triangles; ++j) {
        if (passes && surface.triangles[j].door) continue;
        const auto& corner = surface.triangles[j].corner;
        const V3<double> a = load3<double>(pose.after, corner[0]), b = load3<double>(pose.after, corner[1]),
                         d = load3<double>(pose.after, corner[2]);
        double part;
        if (!leaves_through(from, to, a, b, d, part) || part >= first) continue;
        first = part;
        const V3<double> out = cross(b - a, d - a), foot = madd(part, to - from, from);
        at = foot;
        const double area = norm(out);
        exit = plane_of(surface, view, (-1 / area) * out, (dot(a - to, out)) / area,
                        {foot, foot - (a - load3<double>(pose.before, corner[0])), foot});
      }
    }
  }
  return first <= 1;
}

/// Where a wall that was met on the way goes: in place of one that faces as it does, or where there is room, or in
/// place of the one that is farthest away. -1: nowhere.
int slot_for(const WallPlane& plane, const V3<double>& to, const bool* taken, const NodeWalls& walls) {
  int farthest = -1;
  double most = 0;
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& w = walls.planes[k];
    if (dot(w.normal, plane.normal) > tunables::same_wall || one_soft_wall(w, plane)) return k;
    const double away = dot(w.normal, to) - w.place;
    if (taken[k] || (farthest >= 0 && away < most)) continue;
    farthest = k, most = away;
  }
  return walls.count < max_planes ? walls.count : farthest;
}

}  // namespace

void move_walls(const Model& model, const Inputs& inputs, double from, double to, Scratch& scratch) {
  for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
    const Surface& surface = *model.surfaces[k];
    const SurfaceMotion whole = k < inputs.surfaces.size() ? inputs.surfaces[k] : SurfaceMotion{};
    set_motion(surface, part_of(whole, surface.frames, from, to), scratch.surfaces[k]);
  }
}

void find_walls(const Model& model, const Strand& strand, Scratch& scratch) {
  if (model.surfaces.empty()) return;
  RodScratch& s = *strand.s;
  ContactScratch& c = *strand.contact;
  const Rod& rod = s.inside;
  const RodState& own = *strand.own;
  for (int i = rod.first; i < rod.nodes(); ++i) c.walls[i].count = 0;
  for (int begin = first_free(s); begin <= last_free(s); begin += block) {
    const int end = std::min(begin + block, last_free(s) + 1);
    Bounds bounds;
    Block nodes;
    for (int k = 0; k < block; ++k) nodes.set(k, {}, -1);
    for (int i = begin; i < end; ++i) {
      const V3<double> p = load3<double>(own.position, i);
      const double expected = norm(load3<double>(s.position, i) - p);
      c.travel.at(0)[i] = model.sweep ? expected + tunables::wall_slack_m : 0;
      const double reach = rod.radius.at(0)[i] + c.travel.at(0)[i];
      bounds.take(p, reach);
      nodes.set(i - begin, p, reach);
    }
    for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
      const Surface& surface = *model.surfaces[k];
      find_clusters(surface, bounds.low, bounds.high, scratch.surfaces[k], c.clusters,
                    [&](const V3<double>& low, const V3<double>& high) { return nodes.near(low, high, 0) != 0; });
      for (int cluster : c.clusters) {
        const ClusterPose& pose = pose_of(surface, cluster, scratch.surfaces[k]);
        const double move = model.sweep ? pose.largest_move : 0;
        for (unsigned left = nodes.near(pose.low, pose.high, move); left != 0; left &= left - 1) {
          const int i = begin + std::countr_zero(left);
          const View view = view_of(rod, own, i, load3<double>(own.position, i), c.travel.at(0)[i] + move);
          look(model, static_cast<int>(k), cluster, pose, pose.before, view,
               lets_through(surface, scratch.surfaces[k], view.radius), c.walls[i]);
        }
      }
    }
    for (int i = begin; i < end; ++i) {
      if (any_soft(c.walls[i])) join_soft_walls(view_of(rod, own, i, load3<double>(own.position, i), 0), c.walls[i]);
      drop_walls_seen_from_behind(c.walls[i]);
    }
  }
}

void look_again(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch) {
  NodeWalls& walls = strand.contact->walls[i];
  for (int k = walls.count - 1; k >= 0; --k) {
    WallPlane& w = walls.planes[k];
    if (w.triangle < 0 || w.active || dot(w.normal, to) >= w.place) continue;
    if (is_in_the_way(model, strand, i, to, scratch, w)) continue;
    std::copy(walls.planes + k + 1, walls.planes + walls.count, walls.planes + k);
    --walls.count;
  }
}

bool follow(const Model& model, const RodState& own, int i, const V3<double>& to, Scratch& scratch, RodScratch& s,
            ContactScratch& c) {
  NodeWalls& walls = c.walls[i];
  const V3<double> start = load3<double>(own.position, i);
  const V3<double> from = walls.count > 0 ? start + walls.planes[0].carried : start;
  const View view = view_of(s.inside, own, i, to, tunables::wall_slack_m);
  NodeWalls met;
  WallPlane exit;
  V3<double> reached = to;
  if (first_exit(model, from, to, view, scratch, c.clusters, exit, reached)) {
    met.planes[met.count++] = exit;
  } else {
    Bounds bounds;
    bounds.take(to, view.reach);
    for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
      const Surface& surface = *model.surfaces[k];
      find_clusters(surface, bounds.low, bounds.high, scratch.surfaces[k], c.clusters);
      for (int cluster : c.clusters) {
        const ClusterPose& pose = pose_of(surface, cluster, scratch.surfaces[k]);
        look(model, static_cast<int>(k), cluster, pose, pose.after, view,
             lets_through(surface, scratch.surfaces[k], view.radius), met);
      }
    }
    if (any_soft(met)) join_soft_walls(view, met);
    drop_walls_seen_from_behind(met);
  }
  bool any = drop_passed_walls(from, reached, view.radius, walls), taken[max_planes] = {};
  for (int k = 0; k < met.count; ++k) {
    WallPlane& plane = met.planes[k];
    const double behind = plane.place - dot(plane.normal, to);
    if (!(behind > tunables::followed_m)) continue;
    const int at = slot_for(plane, to, taken, walls);
    if (at < 0) continue;
    WallPlane& old = walls.planes[at];
    // The same once more, which gives by what the node presses it with.
    if (at < walls.count && old.active && old.place - dot(old.normal, to) > behind - tunables::followed_m) continue;
    plane.active = true, any = taken[at] = true;
    old = plane;
    walls.count = std::max(walls.count, at + 1);
  }
  return any;
}

}  // namespace ostium
