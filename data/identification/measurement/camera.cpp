#include "data/identification/measurement/camera.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace ostium::data {

namespace {
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
}  // namespace

Vector3d Camera::outwards() const {
  const Vector3d across = u.cross(v).normalized();
  return across.dot(pixel_0_0_m - source_m) < 0 ? Vector3d(-across) : across;
}

Vector2d Camera::operator()(const Vector3d& p) const {
  const Vector3d n = outwards(), ray = p - source_m;
  const double depth = n.dot(ray);
  if (!(depth > 0)) return Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Vector3d on_detector = source_m + source_to_detector_m() / depth * ray - pixel_0_0_m;
  const Vector2d from_middle = Vector2d(u.dot(on_detector), v.dot(on_detector)) / pixel_m - middle_px();
  const double r2 = from_middle.squaredNorm() / (0.25 * columns * columns);
  return middle_px() + shift_px + (1 + pincushion * r2) * (Eigen::Rotation2Dd(s_turn_rad * r2) * from_middle);
}

void turn_about(Camera& camera, const Vector3d& centre, const Matrix3d& R) {
  camera.source_m = centre + R * (camera.source_m - centre);
  camera.pixel_0_0_m = centre + R * (camera.pixel_0_0_m - centre);
  camera.u = R * camera.u, camera.v = R * camera.v;
}

Vector3d isocentre_m(const std::vector<Camera>& cameras) {
  constexpr double pull = 1e-9;  // decides only what the rays leave open
  Matrix3d A = pull * Matrix3d::Identity();
  Vector3d b = Vector3d::Zero();
  for (const Camera& c : cameras) {
    const Vector3d along = (c.pixel_in_room(c.middle_px()) - c.source_m).normalized();
    const Matrix3d across = Matrix3d::Identity() - along * along.transpose();
    A += across, b += across * c.source_m;
  }
  return A.ldlt().solve(b);
}

GantryAngles gantry_angles(const Vector3d& n) {
  return {std::atan2(n.x(), -n.y()), std::asin(std::fmin(std::fmax(n.z(), -1), 1))};
}

Vector3d outwards_at(const GantryAngles& a) {
  return {std::sin(a.primary_rad) * std::cos(a.secondary_rad), -std::cos(a.primary_rad) * std::cos(a.secondary_rad),
          std::sin(a.secondary_rad)};
}

/// The C-arm slides in its holder about the horizontal axis that turns with the primary angle.
Matrix3d gantry_turn(const GantryAngles& from, const GantryAngles& more) {
  const Vector3d across(std::cos(from.primary_rad), std::sin(from.primary_rad), 0);
  return (Eigen::AngleAxisd(more.primary_rad, Vector3d::UnitZ()) * Eigen::AngleAxisd(-more.secondary_rad, across))
      .toRotationMatrix();
}

}  // namespace ostium::data
