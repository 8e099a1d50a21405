/// Thickness of a sphere, a cylinder and an oblique slab along each pixel's ray, against closed forms.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "app/gates/gate.h"
#include "app/gates/xray/xray_water.h"

namespace ostium::app::gates {

namespace {

using Eigen::Vector3d;

/// Length within the body of the ray from p_PS in the unit direction d; negative: skip this pixel.
using Exact = std::function<double(const Vector3d& p_PS, const Vector3d& d)>;

struct Case {
  const char* name;
  fluoro::phantom::Surface surface;
  Exact exact;
};

constexpr double radius = 0.04;
const Vector3d centre(0.006, -0.004, 0.01);

double chord(double half_squared) { return half_squared > 0 ? 2 * std::sqrt(half_squared) : 0; }

double in_sphere(const Vector3d& p_PS, const Vector3d& d) {
  const Vector3d to = centre - p_PS;
  return chord(radius * radius - (to - to.dot(d) * d).squaredNorm());
}

/// A cylinder along y that extends beyond the picture.
double in_cylinder(const Vector3d& p_PS, const Vector3d& d) {
  const Eigen::Vector2d across(d.x(), d.z()), to(centre.x() - p_PS.x(), centre.z() - p_PS.z());
  const Eigen::Vector2d unit = across.normalized();
  return chord(radius * radius - (to - to.dot(unit) * unit).squaredNorm()) / across.norm();
}

/// A slab from z = -thickness / 2 to thickness / 2, wider than the picture.
constexpr double thickness = 0.05;
double in_slab(const Vector3d&, const Vector3d& d) { return thickness / std::fabs(d.z()); }

double rms_mm(fluoro::PathLengthRenderer& renderer, const Case& c) {
  fluoro::View view;
  view.arm.lao_rad = 0.5;
  view.arm.cran_rad = 0.3;
  fluoro::PathLengths lengths(view.pixels);
  const std::vector<fluoro::Body> bodies{
      fluoro::phantom::body(c.name, c.surface, fluoro::tissue::soft, fluoro::tissue::air)};
  renderer.add(view, bodies, lengths);
  if (find_leak(lengths)) return NAN;
  const fluoro::Plane along_ray = lengths.soft_m() * ray_stretch(view);
  const fluoro::ImageAxes axes(view.arm);
  const Vector3d p_PS = source(view.arm);
  double squares = 0;
  long count = 0;
  for (int row = 0; row < view.pixels; ++row)
    for (int column = 0; column < view.pixels; ++column) {
      const double right = ((column + 0.5) / view.pixels - 0.5) * view.field_m,
                   up = (0.5 - (row + 0.5) / view.pixels) * view.field_m;
      const Vector3d d =
          (right * axes.right + up * axes.up + view.arm.source_to_detector_m * axes.outwards).normalized();
      const double exact = c.exact(p_PS, d), error = along_ray(row, column) - exact;
      if (exact == 0 && error == 0) continue;
      squares += error * error;
      ++count;
    }
  return 1e3 * std::sqrt(squares / double(count));
}

/// EGL where there is one.
std::vector<std::unique_ptr<fluoro::PathLengthRenderer>> renderers() {
  std::vector<std::unique_ptr<fluoro::PathLengthRenderer>> out;
  out.push_back(fluoro::make_scanline_renderer());
  out.push_back(fluoro::make_osmesa_renderer());
  try {
    out.push_back(fluoro::make_egl_renderer());
  } catch (const std::runtime_error& missing) {
    fmt::print(stderr, "{}; its gates are left out\n", missing.what());
  }
  return out;
}

}  // namespace

std::vector<data::GateResult> xray_thickness(bool quick) {
  const Eigen::Matrix3Xd axis =
      fluoro::phantom::smooth_line({centre - Vector3d(0, 0.3, 0), centre + Vector3d(0, 0.3, 0)}, 0.02);
  std::vector<Case> cases;
  cases.push_back({"sphere",
                   fluoro::phantom::star(
                       centre, [](const Vector3d&) { return radius; }, 100),
                   in_sphere});  // 40,000 triangles
  if (!quick) {
    cases.push_back({"cylinder",
                     fluoro::phantom::tube(axis, Eigen::VectorXd::Constant(axis.cols(), radius), 640, false),
                     in_cylinder});
    cases.push_back(
        {"slab", fluoro::phantom::brick({-0.4, -0.4, -0.5 * thickness}, {0.4, 0.4, 0.5 * thickness}), in_slab});
  }
  std::vector<data::GateResult> out;
  for (const auto& renderer : renderers())
    for (const Case& c : cases)
      out.push_back(
          {std::string("xray-thickness-") + c.name + "-" + renderer->name(), rms_mm(*renderer, c), 0, 0.05, "mm"});
  return out;
}

}  // namespace ostium::app::gates
