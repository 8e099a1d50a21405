#pragma once
/// A surface at both ends of a step, computed where it is asked for.
#include "core/math/field.h"
#include "core/surface/surface.h"

namespace ostium {

/// One end of a step.
struct SurfaceMoment {
  int frame[4] = {};  ///< whose positions are mixed, and
  double weight[4] = {};
  Eigen::Vector3d shift_W = Eigen::Vector3d::Zero();
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
  bool goes_on = false;  ///< this step begins where the last one ended, on the same surface
};

/// Makes `pose` that of a new step.
void set_motion(const Surface& surface, const SurfaceMotion& motion, SurfacePose& pose);

/// Clusters that may touch a box during the step: writes their numbers to `found`, in a fixed order.
void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, SurfacePose& pose,
                   std::vector<int>& found);

/// A cluster in this step.
const ClusterPose& pose_of(const Surface& surface, int cluster, SurfacePose& pose);

}  // namespace ostium
