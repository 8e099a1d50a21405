#include "app/angiography/device_scene.h"

#include <cmath>

#include "core/base/units.h"
#include "fluoro/matter/tissue.h"

namespace ostium::app {

namespace {

using units::pi;
constexpr int around = 20;

fluoro::Shaft line(const std::string& name, const std::vector<Eigen::Vector3d>& points, fluoro::Material material,
                   double outer_m, double inner_m = 0, double filling = 1) {
  fluoro::Shaft shaft{
      .name = name, .p_P = Eigen::Matrix3Xd(3, points.size()), .sections = {}, .lumen_iodine_kg_m3 = {}};
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    shaft.p_P.col(static_cast<Eigen::Index>(i)) = points[i];
    if (i) length += (points[i] - points[i - 1]).norm();
  }
  shaft.sections = {{0, length, material, outer_m, inner_m, filling}};
  return shaft;
}

/// A closed surface of revolution about the path, tapered at its ends.
fluoro::Body body_of(const std::string& name, const std::vector<Eigen::Vector3d>& axis,
                     const std::vector<vascular::PathFrame>& frames, const std::vector<double>& radius_m,
                     double iodine_kg_m3) {
  const int rings = static_cast<int>(axis.size());
  fluoro::Body body{.name = name,
                    .triangles = nullptr,
                    .p_P = Eigen::Matrix3Xf(3, rings * around + 2),
                    .tissue = fluoro::tissue::blood,
                    .within = fluoro::tissue::blood,
                    .contrast = {}};
  body.contrast.iodine_kg_m3 = Eigen::VectorXf::Constant(rings * around + 2, static_cast<float>(iodine_kg_m3));
  body.contrast.p_PC = Eigen::Matrix3Xf(3, rings * around + 2);
  auto triangles = std::make_shared<fluoro::Triangles>(3, 2 * around * (rings - 1) + 2 * around);
  int t = 0;
  for (int k = 0; k < rings; ++k)
    for (int j = 0; j < around; ++j) {
      const double a = 2 * pi * j / around;
      const int v = k * around + j, w = k * around + (j + 1) % around;
      body.p_P.col(v) =
          (axis[k] + radius_m[k] * (std::cos(a) * frames[k].side + std::sin(a) * frames[k].up)).cast<float>();
      body.contrast.p_PC.col(v) = axis[k].cast<float>();
      if (k + 1 < rings) {
        triangles->col(t++) = Eigen::Vector3i(v, w, w + around);
        triangles->col(t++) = Eigen::Vector3i(v, w + around, v + around);
      }
    }
  const int low = rings * around, high = low + 1;
  for (int end : {low, high}) {
    const int k = end == low ? 0 : rings - 1;
    body.p_P.col(end) = body.contrast.p_PC.col(end) = axis[k].cast<float>();
    for (int j = 0; j < around; ++j) {
      const int v = k * around + j, w = k * around + (j + 1) % around;
      triangles->col(t++) = end == low ? Eigen::Vector3i(end, w, v) : Eigen::Vector3i(end, v, w);
    }
  }
  body.triangles = triangles;
  return body;
}

}  // namespace

void add_balloon(const vascular::BalloonModel& model, const vascular::BalloonState& state,
                 const vascular::VesselPath& path, const vascular::LumenMap& map, const vascular::LumenMoment& moment,
                 bool markers, fluoro::Scene& scene) {
  std::vector<Eigen::Vector3d> axis;
  std::vector<vascular::PathFrame> frames;
  std::vector<double> radius;
  for (int i = 0; i < vascular::balloon_spheres; i += 3) {
    frames.push_back(frame_at(map, path, sphere_position(model, state, i), moment));
    const Eigen::Vector2d aside_m = state.aside_m[static_cast<std::size_t>(i)];
    axis.push_back(frames.back().centre + aside_m.x() * frames.back().side + aside_m.y() * frames.back().up);
    radius.push_back(state.radius_m[i]);
  }
  // Its contrast displaces blood; a folded balloon holds none.
  if (state.pressure_Pa > 0 || state.was_filled)
    scene.moving.push_back(body_of("balloon", axis, frames, radius, model.iodine_kg_m3));
  if (!markers) return;
  for (double end : {-0.5, 0.5}) {
    const double at = state.seat_m + end * model.length_m;
    std::vector<Eigen::Vector3d> band;
    for (double x : {-0.5e-3, 0.5e-3}) band.push_back(frame_at(map, path, at + x, moment).centre);
    scene.shafts.push_back(line("marker", band, fluoro::Material::platinum, 0.31e-3, 0.26e-3));
  }
}

void add_stent(const vascular::StentModel& model, const vascular::StentState& state, const vascular::VesselPath& path,
               const vascular::Patient& patient, const vascular::LumenMap& map, const vascular::WallShape& shape,
               std::span<const double> radius_m, const vascular::LumenMoment& moment,
               const std::function<Eigen::Vector2d(double)>& aside_m, fluoro::Scene& scene) {
  const std::vector<Eigen::Vector3d> points = is_tied(state)
                                                  ? points_on_wall(model, state, patient, shape, radius_m, moment)
                                                  : points_on_path(model, state, map, path, moment, aside_m);
  for (const auto& [a, b] : struts_of(model))
    scene.shafts.push_back(line("strut", {points[a], points[b]}, fluoro::Material::cobalt_chromium, model.strut_m / 2));
}

void add_pools(const vascular::InjuryState& injuries, const vascular::LumenMap& map, std::span<const double> radius_m,
               const vascular::LumenMoment& moment, fluoro::Scene& scene) {
  for (const vascular::Injury& injury : injuries.injuries) {
    if (injury.cell < 0 || injury.outside_kg <= 0) continue;
    // A cloud beside the lumen with the volume that has leaked.
    const auto cell = static_cast<std::size_t>(injury.cell);
    const Eigen::Vector3d p = map.centre(cell, moment);
    const double r = std::cbrt(injury.outside_m3 * 3 / (4 * pi)), out = radius_m[cell] + 0.6 * r;
    vascular::PathFrame frame{p, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
    std::vector<Eigen::Vector3d> axis;
    std::vector<double> radius;
    for (int k = 0; k < 9; ++k) {
      const double x = -0.98 + 1.96 * k / 8;
      axis.push_back(p + out * frame.side + r * x * frame.along), radius.push_back(r * std::sqrt(1 - x * x));
    }
    fluoro::Body cloud = body_of("outside the lumen", axis, std::vector<vascular::PathFrame>(9, frame), radius,
                                 injury.outside_kg / injury.outside_m3);
    cloud.within = fluoro::tissue::soft;
    scene.moving.push_back(std::move(cloud));
  }
}

void add_devices(const Bedside& bed, const Plan& plan, const vascular::Patient& patient, PatientScene& scene,
                 bool wire) {
  const double phase = bed.blood.heart.phase;
  if (wire) {
    std::vector<Eigen::Vector3d> points;
    for (int cell : plan.path.cells)
      points.insert(points.begin(), scene.map().coronary.position(static_cast<std::size_t>(cell), phase));
    fluoro::Shaft shaft = line("wire", points, fluoro::Material::steel, 0.1e-3);
    shaft.sections.push_back({0, 0.03, fluoro::Material::platinum, 0.178e-3, 0.12e-3, 0.8});
    scene.scene().shafts.push_back(shaft);
  }
  for (std::size_t i = 0; i < bed.state.stents.size(); ++i) {
    const vascular::StentState& stent = bed.state.stents[i];
    const bool mine = bed.device.balloons[0].balloon >= 0 &&
                      bed.treatment.stent_on[bed.device.balloons[0].balloon] == static_cast<int>(i);
    if (stent.where == vascular::StentState::deployed || (stent.where == vascular::StentState::on_balloon && mine))
      add_stent(bed.treatment.stents[i], stent, plan.path, patient, scene.map(), scene.shape(), bed.blood.radius_m,
                {.phase = phase}, {}, scene.scene());
  }
  if (bed.device.balloons[0].balloon >= 0)
    add_balloon(bed.treatment.balloons[bed.device.balloons[0].balloon], bed.state.balloons[0], plan.path, scene.map(),
                {.phase = phase}, true, scene.scene());
  add_pools(bed.state.injury, scene.map(), bed.blood.radius_m, {.phase = phase}, scene.scene());
}

}  // namespace ostium::app
