#pragma once
/// The carrier of nested instruments: its frames and strains. Internal to this folder.
#include <Eigen/Geometry>

#include "core/concentric_tubes/concentric.h"

namespace ostium::core {

inline Eigen::Quaterniond quaternion(const Eigen::Vector4d& q) { return {q[0], q[1], q[2], q[3]}; }
inline Eigen::Vector4d coefficients(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline Eigen::Quaterniond rotation(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

/// Gives the carrier the rest shape and the base frame that follow from the angles.
void turn_carrier(const Concentric& nest, const EndState& base, const ConcentricState& state, Rod& rod, EndState& held);

/// The carrier's Darboux vectors at its joints; zero at the free tip.
Eigen::Matrix3Xd strains(const Rod& rod, const RodState& state);

}  // namespace ostium::core
