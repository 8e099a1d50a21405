#include "fluoro/c_arm.h"

#include <Eigen/Geometry>
#include <cmath>

namespace ostium {

namespace {

/// Image axes: right lies in the transverse plane, up completes right x up = towards the detector.
struct ImageAxes {
  Eigen::Vector3d right, up, outwards;

  explicit ImageAxes(const CArm& arm)
      : right(std::cos(arm.lao_rad), 0, -std::sin(arm.lao_rad)), outwards(towards_detector(arm)) {
    up = outwards.cross(right);
  }
};

}  // namespace

Eigen::Vector3d towards_detector(const CArm& arm) {
  return {std::sin(arm.lao_rad) * std::cos(arm.cran_rad), std::sin(arm.cran_rad),
          std::cos(arm.lao_rad) * std::cos(arm.cran_rad)};
}

Eigen::Vector3d source(const CArm& arm) { return arm.p_PI - arm.source_to_isocentre_m * towards_detector(arm); }

std::optional<Eigen::Vector2d> project(const CArm& arm, const Eigen::Vector3d& p_P) {
  const ImageAxes axes(arm);
  const Eigen::Vector3d ray = p_P - source(arm);
  const double depth = ray.dot(axes.outwards);
  if (!(depth > 0)) return {};
  return arm.source_to_detector_m / depth * Eigen::Vector2d(ray.dot(axes.right), ray.dot(axes.up));
}

}  // namespace ostium
