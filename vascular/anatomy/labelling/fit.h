#pragma once
/// Rotation, scale and shift that fit one set of points to another.
#include <Eigen/Geometry>
#include <vector>

namespace ostium::vascular {

struct Similarity {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  double scale = 1;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double rms_m = 0;  ///< residual
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return scale * (R * p) + shift; }
};

/// Least-squares fit of from[i] to to[i] (Umeyama, IEEE PAMI 1991;13:376); never a reflection.
Similarity nearest_similarity(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to);

/// The rotation with entries 0, 1, -1 that is nearest to `R`, and the angle between them.
Eigen::Matrix3d nearest_axes(const Eigen::Matrix3d& R, double* angle_rad = nullptr);

}  // namespace ostium::vascular
