#pragma once
/// A surface at both ends of a step, computed where it is asked for.
#include <algorithm>

#include "core/math/field.h"
#include "core/surface/surface.h"

namespace ostium {

/// One end of a step.
struct SurfaceMoment {
  int frame[4] = {};  ///< whose positions are mixed, and
  double weight[4] = {};
  Eigen::Vector3d shift_W = Eigen::Vector3d::Zero();
  double sway = 0;  ///< 0 of a surface that does not
  int interval = 0;
  bool operator==(const SurfaceMoment&) const = default;
};

/// A cluster, m.
struct ClusterPose {
  V3<double> low, high;     ///< the box of its corners during the step
  double largest_move = 0;  ///< of a corner in the step
  Field<3> before, after;   ///< (#corners)
  Field<4> balls;           ///< (#triangles): centre and radius of a ball around each, during the step
  long computed = -1;       ///< in which step
};

struct SurfacePose {
  explicit SurfacePose(const Surface& surface);

  SurfaceMoment before, after;
  std::vector<ClusterPose> clusters;
  std::vector<long> listed;  ///< per cluster: the last query that found it
  long step = 0, query = 0, edits = -1;
  long stands_since = 0;  ///< the step since which what stands still in the cycle is where it is
  bool door_open = false;
  bool goes_on = false;  ///< this step begins where the last one ended, on the same surface
};

/// Makes `pose` that of a new step.
void set_motion(const Surface& surface, const SurfaceMotion& motion, SurfacePose& pose);

/// Clusters that may touch a box during the step, and of whose own box, that holds them meanwhile, near(low, high) is
/// true: writes their numbers to `found`, in a fixed order.
template <class Near>
void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, SurfacePose& pose,
                   std::vector<int>& found, Near&& near) {
  found.clear();
  ++pose.query;
  const int nodes = static_cast<int>(surface.nodes.size());
  // Boxes are moved as far as their corners may sway during the step; mostly it does not.
  const bool sways = pose.before.sway != 0 || pose.after.sway != 0;
  const float least = static_cast<float>(std::min(pose.before.sway, pose.after.sway)),
              most = static_cast<float>(std::max(pose.before.sway, pose.after.sway));
  const auto swayed = [&](int n, Box b) {
    const Box& by = surface.sway_boxes[n];
    for (int axis = 0; axis < 3; ++axis) {
      b.low[axis] += by.low[axis] * (by.low[axis] < 0 ? most : least);
      b.high[axis] += by.high[axis] * (by.high[axis] > 0 ? most : least);
    }
    return b;
  };
  for (const SurfaceMoment* m : {&pose.before, &pose.after}) {
    if (m == &pose.after && m->interval == pose.before.interval && m->shift_W == pose.before.shift_W) break;
    const Box* boxes = &surface.boxes[std::size_t{1} * m->interval * nodes];
    const V3<double> shift{m->shift_W[0], m->shift_W[1], m->shift_W[2]};
    const V3<double> l = low - shift, h = high - shift;
    const float lx = l.x, ly = l.y, lz = l.z, hx = h.x, hy = h.y, hz = h.z;
    for (int n = 0; n < nodes;) {
      const Box b = sways ? swayed(n, boxes[n]) : boxes[n];
      const Surface::Node& node = surface.nodes[n];
      if (b.low[0] > hx || b.low[1] > hy || b.low[2] > hz || b.high[0] < lx || b.high[1] < ly || b.high[2] < lz) {
        n = node.skip;
        continue;
      }
      ++n;
      if (node.cluster < 0 || pose.listed[node.cluster] == pose.query) continue;
      if (!near(shift + V3<double>{b.low[0], b.low[1], b.low[2]}, shift + V3<double>{b.high[0], b.high[1], b.high[2]}))
        continue;
      pose.listed[node.cluster] = pose.query;
      found.push_back(node.cluster);
    }
  }
}
inline void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, SurfacePose& pose,
                          std::vector<int>& found) {
  find_clusters(surface, low, high, pose, found, [](const V3<double>&, const V3<double>&) { return true; });
}

/// A cluster in this step.
const ClusterPose& pose_of(const Surface& surface, int cluster, SurfacePose& pose);

}  // namespace ostium
