#include "vascular/thorax/chest_wall.h"

#include <cmath>

#include "vascular/thorax/shapes.h"

namespace ostium::vascular {

namespace {

using units::mm;

constexpr double cage_z_mm = -8, trunk_z_mm = -12;
constexpr double trunk_width_mm = 182, trunk_height_mm = 420, trunk_depth_mm = 128;
constexpr double square_behind = 3;  // exponent of the cage's contour behind; in front 2, an ellipse

/// The contour's half axes, and its exponent, on that side of its widest line.
struct CageOutline {
  Eigen::Vector2d half_mm;
  double exponent;
};
CageOutline outline_mm(double y_mm, double margin_mm, double forward) {
  Eigen::Vector2d half = cage_half_axes_mm(y_mm).array() + margin_mm;
  if (forward >= 0) return {half, 2};
  half[1] += 5;
  return {half, square_behind};
}

/// How far the muscles beside the spine, mostly erector spinae, lift the skin, mm.
double muscle_mm(double x_mm) { return 14 * std::exp(-std::pow(std::fabs(x_mm) / 80, 4)); }

}  // namespace

Eigen::Vector2d cage_half_axes_mm(double y_mm) {
  return {144 * std::sqrt(std::max(0.05, 1 - std::pow((y_mm + 90) / 245, 2))),
          101 * std::sqrt(std::max(0.05, 1 - std::pow((y_mm + 70) / 260, 2)))};
}

Eigen::Vector2d cage_mm(double angle_rad, double y_mm, double margin_mm) {
  const auto [half, exponent] = outline_mm(y_mm, margin_mm, -std::cos(angle_rad));
  const double e = 2 / exponent;
  return {half[0] * signed_power(std::sin(angle_rad), e), cage_z_mm - half[1] * signed_power(std::cos(angle_rad), e)};
}

double from_cage_mm(const Eigen::Vector3d& p_mm, double margin_mm) {
  const double z = p_mm.z() - cage_z_mm;
  const auto [half, n] = outline_mm(p_mm.y(), margin_mm, z);
  const double out = std::pow(std::fabs(p_mm.x() - middle_x / mm) / half[0], n) + std::pow(std::fabs(z) / half[1], n);
  return (std::pow(out, 1 / n) - 1) * half.minCoeff();
}

Mesh skin() {
  Mesh out = superellipsoid(Eigen::Vector3d(middle_x / mm, -70, trunk_z_mm) * mm,
                            Eigen::Vector3d(trunk_width_mm, trunk_height_mm, trunk_depth_mm) * mm, 2.7,
                            Eigen::Matrix3d::Identity(), 48);
  for (Eigen::Vector3d& p : out.vertices) {
    const double behind = trunk_z_mm - p.z() / mm;
    if (behind > 0) p.z() -= muscle_mm((p.x() - middle_x) / mm) * behind / trunk_depth_mm * mm;
  }
  return out;
}

Eigen::Vector2d within_skin_mm() { return {trunk_width_mm - 6, trunk_depth_mm - 8}; }

}  // namespace ostium::vascular
