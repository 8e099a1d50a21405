#include "vascular/anatomy/root.h"

namespace ostium::vascular {

namespace {

// The mean heart, mm from the left ostium.
const Eigen::Vector3d mean_axis = Eigen::Vector3d(-0.73, 0.67, 0.13).normalized();
// Dodge 1988: 37 mm along (-14.4, -14.5, 30.9); the mean sinus of Hager 2002 only allows 29.
const Eigen::Vector3d mean_right_ostium = 29.0 / 37 * Eigen::Vector3d(-14.4, -14.5, 30.9);
constexpr double left_above_annulus_mm = 14.4;
constexpr double ostium_radius_mm = 15.5;  // of the mean sinus, at the ostia

}  // namespace

Root make_root(const AnatomyParameters& parameters) {
  // The centre is equally far from both ostia, on the non-coronary side of the line between them.
  const Eigen::Vector3d across = mean_right_ostium - mean_right_ostium.dot(mean_axis) * mean_axis;
  const Eigen::Vector3d forwards = mean_axis.cross(across).normalized();
  const double behind = std::sqrt(ostium_radius_mm * ostium_radius_mm - across.squaredNorm() / 4);
  const Eigen::Vector3d mean_middle = across / 2 - behind * forwards;

  const Eigen::Vector3d turn = parameters.heart_turn_rad;
  const double angle = turn.norm();
  const Eigen::Matrix3d turned =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
  Root root;
  root.heart = parameters.heart_scale * turned;
  root.axis = turned * mean_axis;
  root.to_left = turned * (-mean_middle).normalized();
  root.to_right = turned * (across - mean_middle).normalized();
  root.to_noncoronary = -turned * forwards;
  root.p_middle = mean_middle * 1e-3;
  const double wall = ostium_radius_mm * parameters.sinus_mm / 29.8 * 1e-3;
  root.p_left_ostium = root.p_middle + wall * root.to_left;
  root.p_right_ostium = root.p_middle + wall * root.to_right + mean_right_ostium.dot(mean_axis) * 1e-3 * root.axis;
  root.p_annulus = root.p_middle - left_above_annulus_mm * 1e-3 * root.axis;
  return root;
}

}  // namespace ostium::vascular
