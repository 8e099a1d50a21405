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
  bool operator==(const SurfaceMoment&) const = default;
};

/// Rough bounds of a cluster's triangles during a step, for a first test of eight at a time. Relative to `low` of the
/// cluster's box, m.
struct TriangleBounds {
  float x[cluster_size], y[cluster_size], z[cluster_size], radius[cluster_size];  ///< bounding ball of each
  /// Plane of each at the beginning of the step: unit normal n, and n.p of its points p.
  float normal_x[cluster_size], normal_y[cluster_size], normal_z[cluster_size], height[cluster_size];
};

/// A cluster during the step, m.
struct ClusterPose {
  V3<double> low, high;     ///< box of its corners during the step
  double largest_move = 0;  ///< of a corner during the step
  Field<3> before, after;   ///< (#corners)
  TriangleBounds bounds{};
  long computed = -1;  ///< step for which it was computed
};

struct SurfacePose {
  explicit SurfacePose(const Surface& surface);

  SurfaceMoment before, after;
  std::vector<ClusterPose> clusters;
  std::vector<long> listed;  ///< per cluster: last query that listed it
  long step = 0, query = 0, edits = -1;
  long stands_since = 0;  ///< the step since which parts that stand still in the cycle have not moved
  bool door_open = false;
  bool goes_on = false;  ///< this step begins where the last one ended, on the same surface
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

/// Clusters that may touch a box during the step and whose own box over the step satisfies near(low, high): writes
/// their numbers to `found`, in a fixed order.
template <class Near>
void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, SurfacePose& pose,
                   std::vector<int>& found, Near&& near) {
  found.clear();
  ++pose.query;
  const int nodes = static_cast<int>(surface.nodes.size());
  // Boxes are extended by how far their corners may sway during the step; usually there is none.
  const bool sways = pose.before.sway != 0 || pose.after.sway != 0;
  const __m128 least = _mm_set1_ps(static_cast<float>(std::min(pose.before.sway, pose.after.sway))),
               most = _mm_set1_ps(static_cast<float>(std::max(pose.before.sway, pose.after.sway)));
  const auto sway = [&](int n, BoxEnds& b) {
    const auto [low_by, high_by] = BoxEnds::of(surface.sway_boxes[n]);
    const __m128 down = _mm_cmplt_ps(low_by, _mm_setzero_ps()), up = _mm_cmpgt_ps(high_by, _mm_setzero_ps());
    b.low = _mm_add_ps(b.low, _mm_mul_ps(low_by, _mm_blendv_ps(least, most, down)));
    b.high = _mm_add_ps(b.high, _mm_mul_ps(high_by, _mm_blendv_ps(least, most, up)));
  };
  for (const SurfaceMoment* m : {&pose.before, &pose.after}) {
    if (m == &pose.after && m->interval == pose.before.interval && m->shift_W == pose.before.shift_W) break;
    const Box* boxes = &surface.boxes[std::size_t{1} * m->interval * nodes];
    const V3<double> shift{m->shift_W[0], m->shift_W[1], m->shift_W[2]};
    const BoxQuery query(low - shift, high - shift);
    for (int n = 0; n < nodes;) {
      BoxEnds box = BoxEnds::of(boxes[n]);
      if (sways) sway(n, box);
      const Surface::Node& node = surface.nodes[n];
      if (query.misses(box)) {
        n = node.skip;
        continue;
      }
      ++n;
      if (node.cluster < 0 || pose.listed[node.cluster] == pose.query) continue;
      if (!near(shift + box.lowest(), shift + box.highest())) continue;
      pose.listed[node.cluster] = pose.query;
      found.push_back(node.cluster);
    }
  }
}
inline void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, SurfacePose& pose,
                          std::vector<int>& found) {
  find_clusters(surface, low, high, pose, found, [](const V3<double>&, const V3<double>&) { return true; });
}

/// A cluster's pose in this step, computed if needed.
const ClusterPose& pose_of(const Surface& surface, int cluster, SurfacePose& pose);

}  // namespace ostium::core
