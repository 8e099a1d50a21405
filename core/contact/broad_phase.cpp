/// Finds the walls that a node can reach.
#include "core/contact/broad_phase.h"

#include <algorithm>
#include <bit>

#include "core/base/tolerances.h"
#include "core/contact/contact.h"
#include "core/contact/narrow_phase.h"

namespace ostium::core {

namespace {

constexpr int block = 8;  ///< most nodes that share a query
constexpr double longest_block_m = 16e-3;
constexpr double rounding_m = 1e-9;  ///< rounding margin of a coarse test, before the exact one

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
  if (!see(surface, surface.clusters[wall.cluster], triangle, pose.after, view, sight) ||
      dot(sight.normal, wall.normal) < tolerances::same_side)
    return true;
  WallPlane seen = plane_of(surface, view, triangle, pose, pose.after, sight);
  const NodeWalls& walls = strand.contact->walls[i];
  for (int k = 0; k < walls.count; ++k) {
    const WallPlane& other = walls.planes[k];
    if (&other != &wall && dot(other.normal, seen.normal) > tolerances::same_wall &&
        other.place - dot(other.normal, to) > seen.place - dot(seen.normal, to) - tolerances::wall_loose_m)
      return false;
  }
  seen.gap = wall.gap;
  seen.surface = wall.surface, seen.cluster = wall.cluster, seen.triangle = wall.triangle;
  wall = seen;
  return true;
}

/// Neighbours share a query while they are not far apart: long boxes meet many walls.
int end_of_block(const Rod& rod, int begin, int last) {
  int end = begin + 1;
  for (double length_m = 0; end < last && end - begin < block; ++end) {
    length_m += rod.length.at(0)[end - 1];
    if (length_m > longest_block_m) break;
  }
  return end;
}

/// The nodes of a query, one per SIMD lane, at the beginning of the step; unused lanes reach nothing.
struct Block {
  double x[block], y[block], z[block], reach[block];  ///< how near a wall must come to count
  double dx[block], dy[block], dz[block];             ///< expected move
  double far[block];                                  ///< reach and the length of that move

  void set(int at, const V3<double>& p, const V3<double>& move, double how_near) {
    x[at] = p.x, y[at] = p.y, z[at] = p.z, reach[at] = how_near;
    dx[at] = move.x, dy[at] = move.y, dz[at] = move.z, far[at] = how_near + norm(move);
  }
  /// Which nodes may be near a box in which something lies throughout the step: one bit each.
  unsigned near(const V3<double>& low, const V3<double>& high) const {
    return each(low, high, [this](int k) { return load<Lanes>(far + k); });
  }
  /// Which nodes may be near something that begins in a box and moves like that.
  unsigned near(const V3<double>& low, const V3<double>& high, const ClusterDrift& move) const {
    return each(low, high, [&](int k) {
      const V3<Lanes> past{load<Lanes>(dx + k) - move.drift.x, load<Lanes>(dy + k) - move.drift.y,
                           load<Lanes>(dz + k) - move.drift.z};
      return load<Lanes>(reach + k) + square_root(dot(past, past)) + move.spread;
    });
  }

 private:
  template <class Reach>
  unsigned each(const V3<double>& low, const V3<double>& high, Reach&& how_near) const {
    const auto outside = [](Lanes p, double a, double b) { return largest(Lanes{}, largest(a - p, p - b)); };
    unsigned any = 0;
    for (int k = 0; k < block; k += lane_count) {
      const V3<Lanes> away{outside(load<Lanes>(x + k), low.x, high.x), outside(load<Lanes>(y + k), low.y, high.y),
                           outside(load<Lanes>(z + k), low.z, high.z)};
      const Lanes within = how_near(k) + rounding_m;
      const Lanes counts = _mm256_and_pd(_mm256_cmp_pd(dot(away, away), within * within, _CMP_LE_OQ),
                                         _mm256_cmp_pd(load<Lanes>(reach + k), Lanes{}, _CMP_GT_OQ));
      any |= static_cast<unsigned>(_mm256_movemask_pd(counts)) << k;
    }
    return any;
  }
};

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
  std::size_t lists = 0;
  for (int begin = first_free(s), end; begin <= last_free(s); begin = end) {
    end = end_of_block(rod, begin, last_free(s) + 1);
    Bounds bounds;
    Block nodes;
    NodeView views[block];
    for (int k = 0; k < block; ++k) nodes.set(k, {}, {}, -1);
    for (int i = begin; i < end; ++i) {
      const V3<double> p = load3<double>(own.position, i), expected = load3<double>(s.position, i);
      store3(c.expected, i, expected);
      nodes.set(i - begin, p, model.sweep ? expected - p : V3<double>{},
                rod.radius.at(0)[i] + (model.sweep ? tolerances::wall_slack_m : 0));
      bounds.take(p, nodes.far[i - begin]);
      views[i - begin] = view_of(rod, own, i, p, 0);
    }
    for (std::size_t k = 0; k < model.surfaces.size(); ++k) {
      const Surface& surface = *model.surfaces[k];
      SurfacePose& whole = scratch.surfaces[k];
      find_clusters_again(surface, bounds.low, bounds.high, whole, c.leaves[lists++], c.clusters,
                          [&](int n, const V3<double>& low, const V3<double>& high) {
                            if (nodes.near(low, high) == 0) return false;
                            if (!model.sweep) return true;
                            const RoughPose rough = rough_pose(surface, n, low, high, whole);
                            return nodes.near(rough.low, rough.high, rough.move) != 0;
                          });
      for (int cluster : c.clusters) {
        const ClusterPose& pose = pose_of(surface, cluster, whole);
        const ClusterDrift move = model.sweep ? pose.move : ClusterDrift{};
        for (unsigned left = nodes.near(pose.low, pose.high, move); left != 0; left &= left - 1) {
          const int at = std::countr_zero(left);
          NodeView view = views[at];
          const V3<double> past = V3<double>{nodes.dx[at], nodes.dy[at], nodes.dz[at]} - move.drift;
          view.reach = nodes.reach[at] + norm(past) + move.spread;
          look(model, static_cast<int>(k), cluster, pose, StepEnd::before, view,
               lets_through(surface, whole, view.radius), c.walls[begin + at]);
        }
      }
    }
    for (int i = begin; i < end; ++i) {
      if (c.walls[i].count > 0) sum_up(views[i - begin], c.walls[i]);
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

}  // namespace ostium::core
