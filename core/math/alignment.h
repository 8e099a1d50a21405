#pragma once
/// Rotations that turn directions and points onto others. Compiled once: with Eigen's headers alone each use takes some
/// ten seconds of compilation.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ostium::core {

/// The shortest rotation that turns the direction of `a` into that of `b`, neither of them 0. Opposite ones: about an
/// axis perpendicular to both.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The rotation R of largest trace(R^T M): it turns points p_i onto q_i best, where M = sum q_i p_i^T (Kabsch 1976).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M);

}  // namespace ostium::core
