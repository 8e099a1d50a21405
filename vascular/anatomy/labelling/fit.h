#pragma once
/// Rotation, scale and shift that bring points nearest to others.
#include <Eigen/Geometry>
#include <vector>

namespace ostium::vascular {

struct Similarity {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  double scale = 1;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double rms_m = 0;  ///< of what is left
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return scale * (R * p) + shift; }
};

/// from[i] to to[i], least squares (Umeyama, IEEE PAMI 1991;13:376); never a mirror image.
Similarity nearest_similarity(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to);

/// The rotation with entries 0, 1, -1 that is nearest to `R`, and the angle between both.
Eigen::Matrix3d nearest_axes(const Eigen::Matrix3d& R, double* angle_rad = nullptr);

}  // namespace ostium::vascular
