/// Finds the walls that a node can reach.
#include "core/contact/broad_phase.h"

#include <algorithm>
#include <bit>

#include "core/base/tolerances.h"
#include "core/contact/contact.h"
#include "core/contact/narrow_phase.h"
#include "core/contact/sleep.h"
#include "core/nesting/nest.h"

namespace ostium::core {

namespace {

/// Recomputes a plane from `to`, with the wall as it is at the end of the step. False if another plane already stands
/// for it there.
bool is_in_the_way(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch,
                   WallPlane& wall) {
  const Surface& surface = *model.surfaces[wall.surface];
  const ClusterPose& pose = pose_of(surface, wall.cluster, scratch.surfaces[wall.surface]);
  NodeView view = view_of(strand.s->inside, *strand.own, i, to, 0);
  view.reach *= 2;
  const Surface::Triangle& triangle = surface.triangles[wall.triangle];
  SeenTriangle sight;
  if (!see_again(surface, wall, pose.after, view, sight) || dot(sight.normal, wall.normal) < tolerances::same_side)
    return true;
  WallPlane seen = plane_of(surface, view, triangle, pose, pose.after, sight);
  const NodeWalls& walls = strand.contact->walls[i];
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& other = walls.planes[k];
    if (&other != &wall && dot(other.normal, seen.normal) > tolerances::same_wall &&
        other.place - dot(other.normal, to) > seen.place - dot(seen.normal, to) - tolerances::wall_loose_m)
      return false;
  }
  seen.gap = wall.gap, seen.facing = wall.facing;
  seen.surface = wall.surface, seen.cluster = wall.cluster, seen.triangle = wall.triangle;
  wall = seen;
  return true;
}

}  // namespace

void move_walls(const Model& model, const Inputs& inputs, double from, double to, Scratch& scratch) {
  for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
    const Surface& surface = *model.surfaces[k];
    const SurfaceMotion whole = k < inputs.surfaces.size() ? inputs.surfaces[k] : SurfaceMotion{};
    set_motion(surface, part_of(whole, surface.frames, from, to), scratch.surfaces[k]);
  }
}

namespace {

/// A block of a strand's nodes that looks for walls, or the part of it that is there.
struct Lookout {
  int begin, end;      ///< nodes of the strand
  KeptLeaves* leaves;  ///< of each surface
  NodeBlock nodes;
  NodeView views[NodeBlock::most];
  Bounds bounds;  ///< of all that they may meet

  Lookout(const Model& model, const Strand& strand, int first, Scratch& scratch) : begin(first), end(first + 1) {
    const RodScratch& s = *strand.s;
    const Rod& rod = s.inside;
    const NodeOfRod own = node_of_rod(strand, begin);
    Lookouts& all = scratch.lookouts[own.rod];
    const int block = all.block[own.node];
    leaves = &all.leaves[model.surfaces.size() * static_cast<std::size_t>(block)];
    for (; end <= last_free(s); ++end)
      if (const NodeOfRod next = node_of_rod(strand, end); next.rod != own.rod || all.block[next.node] != block) break;
    for (int i = begin; i < end; ++i) {
      const V3<double> p = load3<double>(strand.own->position, i), expected = load3<double>(s.position, i);
      store3(strand.contact->expected, i, expected);
      nodes.add(p, model.sweep ? expected - p : V3<double>{},
                rod.radius.at(0)[i] + (model.sweep ? tolerances::wall_slack_m : 0));
      bounds.take(p, nodes.far[i - begin]);
      views[i - begin] = view_of(rod, *strand.own, i, p, 0);
    }
  }
};

/// Adds the planes of one cluster to the walls of the nodes. Returns how far outside of their reach it lies.
double look_at(const Model& model, const Lookout& from, int k, int cluster, SurfacePose& whole, NodeWalls* walls) {
  const Surface& surface = *model.surfaces[static_cast<std::size_t>(k)];
  const ClusterPose& pose = pose_of(surface, cluster, whole);
  const ClusterDrift move = model.sweep ? pose.move : ClusterDrift{};
  const unsigned near = from.nodes.near(pose.low, pose.high, move);
  double clearance = from.nodes.clearance(pose.low, pose.high, near);
  for (unsigned left = near; left != 0; left &= left - 1) {
    const int at = std::countr_zero(left);
    NodeView view = from.views[at];
    const V3<double> past = from.nodes.move(at) - move.drift;
    view.reach = from.nodes.reach[at] + norm(past) + move.spread;
    look(model, k, cluster, pose, StepEnd::before, view, lets_through(surface, whole, view.radius),
         walls[from.begin + at]);
    clearance =
        least(clearance, least_distance(pose, surface.clusters[cluster].triangles, view.centre) - from.nodes.reach[at]);
  }
  return clearance;
}

/// Adds the planes of one surface: of those leaves kept from earlier steps that do not sleep.
void look_at_kept(const Model& model, const Lookout& from, int k, SurfacePose& whole, KeptLeaves& kept,
                  NodeWalls* walls) {
  const Surface& surface = *model.surfaces[static_cast<std::size_t>(k)];
  const StepBoxes boxes(surface, whole);
  const Box* over_interval = boxes_of(surface, whole.after.interval);
  SleepWatch watch(surface, whole, from.nodes, kept);
  const Eigen::Vector3d& by = kept.list.shift_W;
  const V3<double> shift{by[0], by[1], by[2]};
  for (std::size_t n = 0; n < kept.list.leaves.size(); ++n) {
    if (watch.sleeps(n)) continue;
    const int leaf = kept.list.leaves[n];
    const BoxEnds box = boxes.of(leaf, over_interval[leaf]);  // counts for what stands still, in all intervals alike
    const RoughPose rough = rough_pose(surface, leaf, shift + box.lowest(), shift + box.highest(), whole);
    watch.lay_down(n, from.nodes.near(rough.low, rough.high, rough.move) == 0
                          ? from.nodes.clearance(rough.low, rough.high)
                          : look_at(model, from, k, surface.nodes[leaf].cluster, whole, walls));
  }
}

}  // namespace

void find_walls(const Model& model, const Strand& strand, Scratch& scratch) {
  if (model.surfaces.empty()) return;
  RodScratch& s = *strand.s;
  ContactScratch& c = *strand.contact;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i) c.walls[i].count = 0;
  for (int begin = first_free(s); begin <= last_free(s);) {
    const Lookout from(model, strand, begin, scratch);
    const auto& [low, high] = from.bounds;
    for (int k = 0; k < static_cast<int>(model.surfaces.size()); ++k) {
      const Surface& surface = *model.surfaces[static_cast<std::size_t>(k)];
      SurfacePose& whole = scratch.surfaces[static_cast<std::size_t>(k)];
      KeptLeaves& kept = from.leaves[k];
      if (renew(surface, low, high, whole, kept.list)) {
        look_at_kept(model, from, k, whole, kept, c.walls.data());
        continue;
      }
      find_clusters(surface, low, high, whole, c.clusters, [&](int n, const V3<double>& l, const V3<double>& h) {
        if (from.nodes.near(l, h) == 0) return false;
        if (!model.sweep) return true;
        const RoughPose rough = rough_pose(surface, n, l, h, whole);
        return from.nodes.near(rough.low, rough.high, rough.move) != 0;
      });
      for (int cluster : c.clusters) look_at(model, from, k, cluster, whole, c.walls.data());
    }
    for (int i = begin; i < from.end; ++i)
      if (c.walls[i].count > 0) sum_up(from.views[i - begin], c.walls[i]);
    begin = from.end;
  }
}

namespace {

void remove(int k, NodeWalls& walls) {
  std::copy(walls.planes + k + 1, walls.planes + walls.count, walls.planes + k);
  --walls.count;
}

/// Whether another active plane holds the node from the opposite side.
bool is_opposed(const WallPlane& wall, const NodeWalls& walls) {
  return std::any_of(walls.planes, walls.planes + walls.count, [&](const WallPlane& other) {
    return other.active && dot(other.normal, wall.normal) < -tolerances::same_side;
  });
}

/// Whether a rim, seen from `to`, does not face the node as its plane does, or is out of sight.
bool has_turned(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch,
                const WallPlane& wall) {
  const Surface& surface = *model.surfaces[wall.surface];
  const ClusterPose& pose = pose_of(surface, wall.cluster, scratch.surfaces[wall.surface]);
  NodeView view = view_of(strand.s->inside, *strand.own, i, to, 0);
  view.reach *= 2;
  SeenTriangle sight;
  return !see_again(surface, wall, pose.after, view, sight) || dot(sight.normal, wall.normal) < 0;
}

}  // namespace

bool look_again(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch) {
  NodeWalls& walls = strand.contact->walls[i];
  bool any = false;
  for (int k = walls.count - 1; k >= 0; --k) {
    WallPlane& w = walls.planes[k];
    if (w.triangle < 0) continue;
    if (w.active) {
      if (!is_opposed(w, walls) || !has_turned(model, strand, i, to, scratch, w)) continue;
      any = true;
      remove(k, walls);
    } else if (dot(w.normal, to) < w.place && !is_in_the_way(model, strand, i, to, scratch, w)) {
      remove(k, walls);
    }
  }
  return any;
}

}  // namespace ostium::core
