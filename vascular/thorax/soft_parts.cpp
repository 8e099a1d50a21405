#include "vascular/thorax/soft_parts.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/implicit/draws.h"
#include "vascular/thorax/shapes.h"

namespace ostium::vascular {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using units::mm, units::pi;

constexpr int lobule_rows = 5;  // its corners are blurred by its size

/// Columns along the surface (twice) and across it.
Matrix3d axes_about(const Vector3d& normal, double turn) {
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Matrix3d out;
  out << std::cos(turn) * u + std::sin(turn) * v, std::cos(turn) * v - std::sin(turn) * u, normal;
  return out;
}

}  // namespace

XrayBody wall_fat(const ChestWall& wall, int lobules, Draws& draw) {
  XrayBody body{.name = "fat of the chest wall", .tissue = BodyTissue::fat, .within = BodyTissue::soft_tissue};
  for (int i = 0; i < lobules; ++i) {
    const double y = draw.between(-230, 140), angle = draw.between(0, 2 * pi), depth = draw.between(0.15, 0.85);
    const Eigen::Vector2d half = (1 - depth) * wall.inner_mm(y) + depth * wall.outer_mm(y);
    const Vector3d p(wall.middle_x_mm + half[0] * std::sin(angle), y, half[1] * std::cos(angle));
    const Vector3d normal = Vector3d(std::sin(angle) / half[0], 0, std::cos(angle) / half[1]).normalized();
    // Long along the ribs, thin across: layers between muscles.
    const double size = std::exp(0.45 * draw.normal());
    append(body.mesh, superellipsoid(p * mm, Vector3d(6.5 * size, 3.6 * size, 1.9 * size) * mm, 2,
                                     axes_about(normal, draw.between(0, pi)), lobule_rows));
  }
  return body;
}

XrayBody heart_fat(const std::function<double(const Vector3d&)>& heart, const Eigen::AlignedBox3d& box, int lobules,
                   Draws& draw) {
  XrayBody body{.name = "fat about the heart", .tissue = BodyTissue::fat, .within = BodyTissue::soft_tissue};
  constexpr double h = 0.5 * mm;
  for (int made = 0, tries = 0; made < lobules && tries < 50 * lobules; ++tries) {
    Vector3d p = box.min() + Vector3d(draw.uniform(), draw.uniform(), draw.uniform()).cwiseProduct(box.sizes());
    const double d = heart(p);
    if (std::fabs(d) > 15 * mm) continue;
    Vector3d normal;
    for (int k = 0; k < 3; ++k) normal[k] = heart(p + h * Vector3d::Unit(k)) - heart(p - h * Vector3d::Unit(k));
    if (normal.norm() < 1e-9) continue;
    normal.normalize();
    p -= (d + 1 * mm) * normal;
    const double size = std::exp(0.4 * draw.normal());
    append(body.mesh, superellipsoid(p, Vector3d(7 * size, 4.5 * size, 2 * size) * mm, 2,
                                     axes_about(normal, draw.between(0, pi)), lobule_rows));
    ++made;
  }
  return body;
}

XrayBody stomach_gas(const std::function<double(double, double)>& dome_mm, Draws& draw) {
  XrayBody body{.name = "gas below the diaphragm", .tissue = BodyTissue::air, .within = BodyTissue::soft_tissue};
  const auto bubble = [&](double x, double z, const Vector3d& half, double below) {
    const Vector3d p(x, dome_mm(x, z) - below - half[1], z);
    append(body.mesh,
           superellipsoid(p * mm, half * mm, 2.2,
                          Eigen::AngleAxisd(0.35 * draw.normal(), Vector3d::UnitZ()).toRotationMatrix(), 14));
  };
  const double fill = draw.uniform();
  bubble(draw.between(62, 84), draw.between(-10, 20), Vector3d(20 + 14 * fill, 10 + 10 * fill, 16 + 10 * fill), 12);
  for (int loop = 0; loop < 2; ++loop)
    bubble(draw.between(70, 95), draw.between(30, 60), Vector3d(12, 9, 11) * draw.between(0.7, 1.3), 40 + 22 * loop);
  return body;
}

}  // namespace ostium::vascular
