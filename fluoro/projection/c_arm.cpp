#include "fluoro/projection/c_arm.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/base/units.h"

namespace ostium::fluoro {

namespace {

void require(double value, double least, double most, double unit, const char* what, const char* unit_name) {
  if (value >= least - 1e-9 && value <= most + 1e-9) return;
  const auto text = [&](double x) {
    const std::string number = std::to_string(std::round(x / unit * 10) / 10);
    if (!std::isfinite(x / unit * 10)) return number;
    return number.substr(0, number.find('.') + 2);
  };
  throw std::invalid_argument(std::string("C-arm: ") + what + " " + text(value) + " " + unit_name +
                              " cannot be reached; it goes from " + text(least) + " to " + text(most) + " " +
                              unit_name);
}

}  // namespace

ImageAxes::ImageAxes(const CArm& arm)
    : right(std::cos(arm.lao_rad), 0, -std::sin(arm.lao_rad)), outwards(towards_detector(arm)) {
  up = outwards.cross(right);
}

void require_reachable(const CArm& arm, const CArmLimits& limits) {
  using units::degree;
  require(arm.lao_rad, -limits.lao_rad, limits.lao_rad, degree, "LAO/RAO angle", "degrees");
  require(arm.cran_rad, -limits.cran_rad, limits.cran_rad, degree, "cranial/caudal angle", "degrees");
  require(arm.source_to_detector_m, limits.shortest_sid_m, limits.longest_sid_m, 0.01, "SID", "cm");
  require(arm.source_to_isocentre_m, 0.5, arm.source_to_detector_m - 0.05, 0.01, "source to isocentre", "cm");
  if (!arm.p_PI.allFinite()) throw std::invalid_argument("C-arm: the isocentre is not a number");
}

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

}  // namespace ostium::fluoro
