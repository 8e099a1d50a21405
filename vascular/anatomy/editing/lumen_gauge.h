#pragma once
/// Measures the lumen around a point: by it a course that somebody edits is fitted and checked.
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/winding.h"

namespace ostium::vascular {

class LumenGauge {
 public:
  /// Keeps a reference to `closed`.
  explicit LumenGauge(const Mesh& closed);

  /// Distance to the wall, m; outside of the lumen negative.
  double clearance_m(const Eigen::Vector3d& p) const;
  /// Where, across the unit vector `along`, the largest sphere about `p` fits: uphill from there. A point outside
  /// stays.
  Eigen::Vector3d centred(const Eigen::Vector3d& p, const Eigen::Vector3d& along) const;

 private:
  WindingNumber winding_;
  BoundingVolumeHierarchy wall_;
};

}  // namespace ostium::vascular
