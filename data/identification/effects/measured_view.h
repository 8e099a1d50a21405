#pragma once
/// How a model's shape appears in the measurement.
#include <Eigen/Geometry>
#include <vector>

#include "data/identification/measurement/camera.h"

namespace ostium::data {

/// measured = A (R model + t) + b; the tracked point is tip + R_tip offset.
struct MeasuredView {
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  Eigen::Vector3d t_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d tip_offset_m = Eigen::Vector3d::Zero();
  /// Imaging errors; A is close to the identity. Only effects change A and b.
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  Eigen::Vector3d b_m = Eigen::Vector3d::Zero();
  /// Of projections: what is measured is seen by these, one for each view of the set.
  std::vector<Camera> cameras = {};

  Eigen::Vector3d operator()(const Eigen::Vector3d& model) const { return A * (R * model + t_m) + b_m; }
};

}  // namespace ostium::data
