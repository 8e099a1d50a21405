#pragma once
/// A surface at both ends of a step, computed on demand.
#include <immintrin.h>

#include <algorithm>
#include <limits>

#include "core/math/field.h"
#include "core/wall/surface.h"

namespace ostium::core {

/// A surface at one end of a step.
struct SurfaceMoment {
  int frame[4] = {};  ///< frames to interpolate between
  double weight[4] = {};
  Eigen::Vector3d shift_W = Eigen::Vector3d::Zero();
  double sway = 0;  ///< 0 if the surface does not sway
  int interval = 0;
  double share = 0;  ///< of the interval that has passed
  bool operator==(const SurfaceMoment&) const = default;
};

/// Rough bounds of a cluster's triangles at the beginning of a step, for a first test of eight at a time. Relative to
/// `low` of the cluster's box, m.
struct TriangleBounds {
  float x[cluster_size], y[cluster_size], z[cluster_size], radius[cluster_size];  ///< bounding ball of each
  /// Plane of each: unit normal n, and n.p of its points p.
  float normal_x[cluster_size], normal_y[cluster_size], normal_z[cluster_size], height[cluster_size];
};

/// How a cluster's corners move during the step, m: all by `drift`, and each by at most `spread` beside that. What
/// moves along with a wall stays as far from it as it was, however far both go.
struct ClusterDrift {
  V3<double> drift;
  double spread = 0;
};

/// A cluster during the step, m.
struct ClusterPose {
  V3<double> low, high;  ///< box of its corners at the beginning of the step
  ClusterDrift move;
  Field<3> before, after;  ///< (#corners)
  TriangleBounds bounds{};
  long computed = -1;  ///< step for which it was computed, and
  int version = 0;     ///< Surface::Cluster::version
};

/// Where a cluster lies, without computing its corners: a box around them at the beginning of the step, and how they
/// move, at most.
struct RoughPose {
  V3<double> low, high;
  ClusterDrift move;
};

struct SurfacePose {
  explicit SurfacePose(const Surface& surface);

  SurfaceMoment before, after;
  std::vector<ClusterPose> clusters;
  long step = 0;
  long stands_since = 0;  ///< the step since which parts that stand still in the cycle have not moved, but for edits
  int posed = 0;          ///< clusters whose pose was computed since this was set to 0
  bool door_open = false;
  bool goes_on = false;       ///< this step begins where the last one ended, but for edits,
  bool begins_again = false;  ///< or where the last one began: a part of it is tried
};

/// Sets `pose` to a new step.
void set_motion(const Surface& surface, const SurfaceMotion& motion, SurfacePose& pose);

/// Both ends of a box, one register each: x, y, z and an unused number; an unused number and x, y, z.
struct BoxEnds {
  __m128 low, high;

  static BoxEnds of(const Box& b) {
    const float* first = reinterpret_cast<const float*>(&b);
    return {_mm_loadu_ps(first), _mm_loadu_ps(first + 2)};
  }
  V3<double> lowest() const { return {low[0], low[1], low[2]}; }
  V3<double> highest() const { return {high[1], high[2], high[3]}; }
};

/// The query box, as bounds for other boxes' low and high ends.
struct BoxQuery {
  __m128 high, low;

  BoxQuery(const V3<double>& l, const V3<double>& h) {
    constexpr float any = std::numeric_limits<float>::infinity();
    high = _mm_setr_ps(static_cast<float>(h.x), static_cast<float>(h.y), static_cast<float>(h.z), any);
    low = _mm_setr_ps(-any, static_cast<float>(l.x), static_cast<float>(l.y), static_cast<float>(l.z));
  }
  bool misses(const BoxEnds& b) const {
    return _mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(b.low, high), _mm_cmplt_ps(b.high, low))) != 0;
  }
};

/// Leaves of a surface's tree near a box that is larger than what a query needs, kept for queries of later steps. What
/// a query finds does not depend on it.
struct LeafList {
  static constexpr std::size_t most = 768;
  V3<double> low, high;  ///< the box that was searched; its leaves are all here
  int interval = -1;     ///< in which steps end; -1: nothing is kept
  double moved_m = 0;    ///< of Surface
  double sway_low = 0, sway_high = 0;
  Eigen::Vector3d shift_W = Eigen::Vector3d::Zero();
  std::vector<int> leaves;  ///< nodes of the tree

  long made = 0;  ///< times that the leaves were searched anew

  LeafList() { leaves.reserve(most); }
};

/// The boxes of the tree at both ends of a step: those of an interval, extended by how far their corners may sway and
/// lie aside.
class StepBoxes {
 public:
  StepBoxes(const Surface& surface, const SurfacePose& pose)
      : surface_(surface), sways_(pose.before.sway != 0 || pose.after.sway != 0) {
    least_ = _mm_set1_ps(static_cast<float>(std::min(pose.before.sway, pose.after.sway)));
    most_ = _mm_set1_ps(static_cast<float>(std::max(pose.before.sway, pose.after.sway)));
  }
  BoxEnds of(int node, const Box& over_interval) const {
    BoxEnds box = BoxEnds::of(over_interval);
    if (surface_.yields()) {
      const BoxEnds by = BoxEnds::of(surface_.aside_boxes[node]);
      box.low = _mm_add_ps(box.low, by.low), box.high = _mm_add_ps(box.high, by.high);
    }
    if (!sways_) return box;
    const auto [low_by, high_by] = BoxEnds::of(surface_.sway_boxes[node]);
    const __m128 down = _mm_cmplt_ps(low_by, _mm_setzero_ps()), up = _mm_cmpgt_ps(high_by, _mm_setzero_ps());
    box.low = _mm_add_ps(box.low, _mm_mul_ps(low_by, _mm_blendv_ps(least_, most_, down)));
    box.high = _mm_add_ps(box.high, _mm_mul_ps(high_by, _mm_blendv_ps(least_, most_, up)));
    return box;
  }

 private:
  const Surface& surface_;
  bool sways_;
  __m128 least_, most_;
};

/// Of all nodes of the tree, over an interval.
inline const Box* boxes_of(const Surface& surface, int interval) {
  return &surface.boxes[static_cast<std::size_t>(interval) * surface.nodes.size()];
}

/// Around both.
inline Box around(const Box& a, const Box& b) {
  Box all = a;
  for (int axis = 0; axis < 3; ++axis)
    all.low[axis] = std::min(a.low[axis], b.low[axis]), all.high[axis] = std::max(a.high[axis], b.high[axis]);
  return all;
}

/// Calls visit(node, box) for the leaves that a box may touch during a step, depth first. If the step passes from one
/// interval to the next, boxes are those over both.
template <class Visit>
void visit_leaves(const Surface& surface, const SurfacePose& pose, const BoxQuery& query, Visit&& visit) {
  const int nodes = static_cast<int>(surface.nodes.size());
  const StepBoxes boxes(surface, pose);
  const Box *before = boxes_of(surface, pose.before.interval), *after = boxes_of(surface, pose.after.interval);
  for (int n = 0; n < nodes;) {
    const Box over_interval = before == after ? after[n] : around(before[n], after[n]);
    const BoxEnds box = boxes.of(n, over_interval);
    const Surface::Node& node = surface.nodes[n];
    if (query.misses(box)) {
      n = node.skip;
      continue;
    }
    if (node.cluster >= 0) visit(n, box);
    ++n;
  }
}

/// Clusters that may touch a box during the step and satisfy near(node, low, high) as leaves of the tree, with their
/// own box over the interval between frames: writes their numbers to `found`, in a fixed order.
template <class Near>
void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, const SurfacePose& pose,
                   std::vector<int>& found, Near&& near) {
  found.clear();
  const Eigen::Vector3d &a = pose.before.shift_W, &b = pose.after.shift_W;
  const V3<double> least_shift{std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2])},
      largest_shift{std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
  visit_leaves(surface, pose, BoxQuery(low - largest_shift, high - least_shift), [&](int n, const BoxEnds& box) {
    if (near(n, least_shift + box.lowest(), largest_shift + box.highest())) found.push_back(surface.nodes[n].cluster);
  });
}
inline void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high,
                          const SurfacePose& pose, std::vector<int>& found) {
  find_clusters(surface, low, high, pose, found, [](int, const V3<double>&, const V3<double>&) { return true; });
}

/// Makes `list` hold every leaf that the box may touch in this step, in the order of find_clusters. False if it cannot:
/// the step passes from one interval to another but the next, or shifts the wall, or there are too many.
bool renew(const Surface& surface, const V3<double>& low, const V3<double>& high, const SurfacePose& pose,
           LeafList& list);

/// The rough pose, in this step, of the cluster at a leaf of the tree whose box over the interval is `low` to `high`;
/// the exact one if that is known already. Of a cluster that stands still only the box is known.
RoughPose rough_pose(const Surface& surface, int node, const V3<double>& low, const V3<double>& high,
                     const SurfacePose& pose);

/// The middle of a cluster's box at a moment, mixed as its corners are: a point that moves with the wall, exactly.
V3<double> middle_of(const Surface& surface, int node, const SurfaceMoment& m);

/// How fast a cluster moves in an interval relative to the middle of another, m per frame of the cycle, at most: the
/// middle of its box, and any corner beside that middle.
struct RelativeSpeed {
  double middle = 0, beside = 0;
};
RelativeSpeed relative_speed(const Surface& surface, int interval, int cluster, int other);
/// How far any corner moves relative to the middle of another leaf, m per unit of sway, at most.
double relative_sway(const Surface& surface, int node, int other_node);

/// A cluster's pose in this step, computed if needed.
const ClusterPose& pose_of(const Surface& surface, int cluster, SurfacePose& pose);

}  // namespace ostium::core
