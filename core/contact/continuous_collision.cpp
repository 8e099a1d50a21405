/// Continuous collision: walls that a node meets on its path through a step.
#include "core/base/tolerances.h"
#include "core/contact/broad_phase.h"
#include "core/contact/contact.h"
#include "core/contact/narrow_phase.h"
#include "core/math/rotation.h"
#include "core/wall/triangle.h"

namespace ostium::core {

namespace {

/// Removes planes that the path from `from` to `to` crosses without meeting a triangle. A wall ends at a ridge but its
/// plane does not, and the planes of a ridge's two sides would trap a node in the solid between them. True if a removed
/// plane was active.
bool drop_passed_walls(const V3<double>& from, const V3<double>& to, double radius, NodeWalls& walls) {
  bool any = false;
  int count = 0;
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& w = walls.planes[k];
    const double surface = w.place - radius;
    if (dot(w.normal, from) >= surface && dot(w.normal, to) < surface - tolerances::passed_wall_m)
      any = any || w.active;
    else
      walls.planes[count++] = w;
  }
  walls.count = count;
  return any;
}

/// Clusters that may touch a box at the end of the step.
void find_at_end(const Surface& surface, const Bounds& bounds, SurfacePose& pose, std::vector<int>& clusters) {
  find_clusters(surface, bounds.low, bounds.high, pose, clusters,
                [&](int n, const V3<double>& low, const V3<double>& high) {
                  const RoughPose rough = rough_pose(surface, n, low, high, pose);
                  const V3<double> by{rough.move.spread, rough.move.spread, rough.move.spread},
                      lowest = rough.low + rough.move.drift - by, highest = rough.high + rough.move.drift + by;
                  return lowest.x <= bounds.high.x && bounds.low.x <= highest.x && lowest.y <= bounds.high.y &&
                         bounds.low.y <= highest.y && lowest.z <= bounds.high.z && bounds.low.z <= highest.z;
                });
}

/// The first triangle through which the path leaves the lumen, as a plane, and the point; with the corners at the end
/// of the step.
bool first_exit(const Model& model, const V3<double>& from, const V3<double>& to, NodeView view, Scratch& scratch,
                std::vector<int>& clusters, WallPlane& exit, V3<double>& at) {
  double first = 2;
  Bounds bounds;
  bounds.take(from, 0), bounds.take(to, 0);
  for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
    const Surface& surface = *model.surfaces[k];
    const bool passes = lets_through(surface, scratch.surfaces[k], view.radius);
    find_at_end(surface, bounds, scratch.surfaces[k], clusters);
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

/// Whether the way leads out of the lumen as the step begins.
bool leaves(const Model& model, const V3<double>& from, const V3<double>& to, double radius, Scratch& scratch,
            std::vector<int>& clusters) {
  Bounds bounds;
  bounds.take(from, 0), bounds.take(to, 0);
  for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
    const Surface& surface = *model.surfaces[k];
    const bool passes = lets_through(surface, scratch.surfaces[k], radius);
    find_clusters(surface, bounds.low, bounds.high, scratch.surfaces[k], clusters);
    for (int cluster : clusters) {
      const ClusterPose& pose = pose_of(surface, cluster, scratch.surfaces[k]);
      const Surface::Cluster& c = surface.clusters[cluster];
      for (int j = c.first_triangle; j < c.first_triangle + c.triangles; ++j) {
        if (passes && surface.triangles[j].door) continue;
        const auto corner = [&](int n) { return load3<double>(pose.before, surface.triangles[j].corner[n]); };
        double part;
        if (leaves_through(from, to, corner(0), corner(1), corner(2), part)) return true;
      }
    }
  }
  return false;
}

/// Index for a plane found on the path: that of a plane with the same direction, else a free one, else that of the
/// farthest plane. -1: none.
int slot_for(const WallPlane& plane, const V3<double>& to, const bool* taken, const NodeWalls& walls) {
  int farthest = -1;
  double most = 0;
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& w = walls.planes[k];
    if (dot(w.normal, plane.normal) > tolerances::same_wall || one_soft_wall(w, plane)) return k;
    const double away = dot(w.normal, to) - w.place;
    if (taken[k] || (farthest >= 0 && away < most)) continue;
    farthest = k, most = away;
  }
  return walls.count < max_planes ? walls.count : farthest;
}

/// The walls round a ball at the end of the step.
void look_around(const Model& model, const NodeView& view, Scratch& scratch, std::vector<int>& clusters,
                 NodeWalls& walls) {
  Bounds bounds;
  bounds.take(view.centre, view.reach);
  for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
    const Surface& surface = *model.surfaces[k];
    find_at_end(surface, bounds, scratch.surfaces[k], clusters);
    for (int cluster : clusters) {
      const ClusterPose& pose = pose_of(surface, cluster, scratch.surfaces[k]);
      look(model, static_cast<int>(k), cluster, pose, StepEnd::after, view,
           lets_through(surface, scratch.surfaces[k], view.radius), walls);
    }
  }
  sum_up(view, walls);
}

/// The path from the start to the wall it met may go round a ridge. The wall's plane extends beyond the ridge and would
/// push the node away from its start, so it is limited to hold from the start onwards.
void spare(const V3<double>& start, WallPlane& plane) {
  if (plane.soft) return;
  plane.place = least(plane.place, dot(plane.normal, start + plane.carried) + tolerances::spared_m);
}

}  // namespace

namespace {

/// Lays the elements from `first` one after the other. False, and nothing moves, if one would lie across a wall.
bool string_from(const Model& model, const Strand& strand, int first, Scratch& scratch) {
  const Rod& rod = strand.s->inside;
  RodState& own = *strand.own;
  const auto next = [&](const V3<double>& p, int i) {
    return madd(rod.length.at(0)[i], director3(load4<double>(own.orientation, i)), p);
  };
  V3<double> p = load3<double>(own.position, first);
  for (int i = first; i < rod.elements; ++i) {
    const V3<double> to = next(p, i);
    if (leaves(model, p, to, rod.radius.at(0)[i + 1], scratch, strand.contact->clusters)) return false;
    p = to;
  }
  p = load3<double>(own.position, first);
  for (int i = first; i < rod.elements; ++i) {
    p = next(p, i);
    for (Field<3>* f : {&own.position, &own.position_before}) store3(*f, i + 1, p);
  }
  return true;
}

}  // namespace

void move_torn_parts(const Model& model, const Strand& strand, Scratch& scratch) {
  for (const Span& span : strand.nest->spans)
    if (span.torn && string_from(model, strand, span.at, scratch)) return;
}

double deeper_than_planes(const Model& model, const RodState& own, int i, const V3<double>& at, Scratch& scratch,
                          const RodScratch& s, ContactScratch& c) {
  const NodeView view = view_of(s.inside, own, i, at, 0);
  NodeWalls around;
  look_around(model, view, scratch, c.clusters, around);
  const auto deepest = [&](const NodeWalls& walls, auto&& counts) {
    double most = 0;
    for (int k = 0; k < walls.count; ++k)
      if (counts(walls.planes[k])) most = largest(most, walls.planes[k].place - dot(walls.planes[k].normal, at));
    return most;
  };
  return deepest(around, [](const WallPlane& w) { return !w.soft; }) -
         deepest(c.walls[i], [](const WallPlane& w) { return w.active; });
}

namespace {

/// The walls that a node meets on its way through the step, and where its path leaves the lumen or ends.
struct Way {
  V3<double> from, reached;
  double radius = 0;
  NodeWalls met;
};

Way way_to(const Model& model, const RodState& own, int i, const V3<double>& to, Scratch& scratch, const RodScratch& s,
           ContactScratch& c) {
  const NodeWalls& walls = c.walls[i];
  const V3<double> start = load3<double>(own.position, i);
  const NodeView view = view_of(s.inside, own, i, to, tolerances::wall_slack_m);
  Way way{walls.count > 0 ? start + walls.planes[0].carried : start, to, view.radius, {}};
  WallPlane exit;
  if (first_exit(model, way.from, to, view, scratch, c.clusters, exit, way.reached))
    way.met.planes[way.met.count++] = exit;
  else
    look_around(model, view, scratch, c.clusters, way.met);
  for (int k = 0; k < way.met.count; ++k) spare(start, way.met.planes[k]);
  return way;
}

}  // namespace

NodeWalls walls_at(const Model& model, const RodState& own, int i, const V3<double>& at, Scratch& scratch,
                   const RodScratch& s, ContactScratch& c) {
  NodeWalls met = way_to(model, own, i, at, scratch, s, c).met;
  for (int k = 0; k < met.count; ++k) met.planes[k].active = dot(met.planes[k].normal, at) < met.planes[k].place;
  return met;
}

bool follow(const Model& model, const RodState& own, int i, const V3<double>& to, Scratch& scratch, RodScratch& s,
            ContactScratch& c) {
  NodeWalls& walls = c.walls[i];
  Way way = way_to(model, own, i, to, scratch, s, c);
  bool any = drop_passed_walls(way.from, way.reached, way.radius, walls), taken[max_planes] = {};
  for (int k = 0; k < way.met.count; ++k) {
    WallPlane& plane = way.met.planes[k];
    const double behind = plane.place - dot(plane.normal, to);
    if (!(behind > tolerances::followed_m)) continue;
    const int at = slot_for(plane, to, taken, walls);
    if (at < 0) continue;
    WallPlane& old = walls.planes[at];
    // The same wall again, pushed in by the node.
    if (at < walls.count && old.active && old.place - dot(old.normal, to) > behind - tolerances::followed_m) continue;
    plane.active = true, any = taken[at] = true;
    old = plane;
    walls.count = std::max(walls.count, at + 1);
  }
  return any;
}

}  // namespace ostium::core
