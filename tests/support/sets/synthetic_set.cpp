#include "tests/support/sets/synthetic_set.h"

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "core/base/units.h"
#include "data/formats/mesh_writer.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::synthetic {

namespace {

using Eigen::Vector3d;

using units::pi, units::mm, units::Nmm2;

/// Normal deviates (Box and Muller), the same with every library.
class Normal {
 public:
  explicit Normal(unsigned seed) : random_(seed) {}
  double operator()() {
    const double u = (random_() + 0.5) / 4294967296.0, v = (random_() + 0.5) / 4294967296.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * v);
  }
  Vector3d vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937 random_;
};

core::Section section(double from_mm, double to_mm, double EI_Nmm2, double GJ_Nmm2, double kg_per_m, double k2_per_mm,
                      double radius_mm, double bore_mm) {
  core::Section s;
  s.from_tip_m = from_mm * mm, s.to_tip_m = to_mm * mm;
  s.EI1_N_m2 = s.EI2_N_m2 = EI_Nmm2 * Nmm2, s.GJ_N_m2 = GJ_Nmm2 * Nmm2;
  s.kg_per_m = kg_per_m;
  s.rest_curvature_per_m = {0, k2_per_mm / mm, 0};
  s.radius_m = radius_mm * mm, s.inner_radius_m = bore_mm * mm;
  return s;
}

/// d3 along x, d1 up.
core::EndState level_base() {
  core::EndState base;
  Eigen::Matrix3d R;
  R.col(2) = Vector3d::UnitX(), R.col(0) = Vector3d::UnitZ();
  R.col(1) = Vector3d(R.col(2)).cross(Vector3d(R.col(0)));
  const Eigen::Quaterniond q(R);
  base.q_W = {q.w(), q.x(), q.y(), q.z()};
  base.p_W = {0.01, -0.02, 0.03};
  return base;
}

}  // namespace

boundary_value::Problem problem_of(const data::MeasurementSet& set, const data::Experiment& e, const Truth& truth) {
  boundary_value::Problem p;
  for (std::size_t i = 0; i < set.instruments.size(); ++i) {
    boundary_value::Tube tube{set.instruments[i].sections, e.set[i].inserted_m, e.set[i].roll_rad, 0};
    for (std::size_t s = 0; s < tube.sections.size(); ++s) {
      const double scale = truth.stiffness_scale.empty() ? 1 : truth.stiffness_scale[i][s];
      tube.sections[s].EI1_N_m2 *= scale, tube.sections[s].EI2_N_m2 *= scale, tube.sections[s].GJ_N_m2 *= scale;
      // The shaft is the part proximal to the insertion; in these sets it lies within the last section.
      if (s + 1 == tube.sections.size())
        tube.shaft_rad_per_Nm = truth.shaft_compliance * e.set[i].shaft_m / tube.sections[s].GJ_N_m2;
    }
    p.tubes.push_back(tube);
  }
  p.base_p = e.base.p_W;
  p.base_R = Eigen::Quaterniond(e.base.q_W[0], e.base.q_W[1], e.base.q_W[2], e.base.q_W[3]).toRotationMatrix();
  p.gravity = set.gravity_m_s2;
  p.tip_force = e.tip_force_N;
  return p;
}

void measure(data::MeasurementSet& set, const Truth& truth, double spacing_m) {
  Normal normal(truth.seed);
  for (data::Experiment& e : set.experiments) {
    const int points = static_cast<int>(std::ceil(e.set.back().inserted_m / spacing_m)) + 1;
    const boundary_value::Solution exact = boundary_value::solve(problem_of(set, e, truth), points);
    if (!exact.converged) throw std::runtime_error("no boundary-value solution of " + e.id);
    e.points_m.clear();
    if (e.kind == data::Experiment::Kind::tip)
      e.points_m = {exact.curve.back() + exact.tip_R * truth.tip_offset_m};
    else
      e.points_m = exact.curve;
    for (Vector3d& p : e.points_m) p = truth.R * p + truth.t_m + truth.sigma_m * normal.vector();
  }
}

data::MeasurementSet free_wire(int experiments) {
  data::MeasurementSet set;
  set.title = "free wire, made by a boundary-value solver", set.source = "tests";
  set.instruments = {{"wire",
                      0.6,
                      0.178 * mm,
                      0,
                      {section(0, 30, 2, 1.5, 5e-4, 0.03, 0.178, 0), section(30, 600, 40, 30, 8e-4, 0, 0.178, 0)}}};
  set.gravity_m_s2 = {0, 0, -9.81};
  set.imaging.noise_sigma_m = 0.15 * mm;
  for (int i = 0; i < experiments; ++i) {
    data::Experiment e;
    e.id = "e" + std::to_string(i);
    e.place = "experiments[" + std::to_string(i) + "]";
    e.base = level_base();
    e.set = {{0.12 + 0.18 * i / std::max(experiments - 1, 1), 40.0 * i * pi / 180, 0}};
    e.specimen.resize(1);
    if (i % 3 == 1) e.tip_force_N = {0, 4e-4, 3e-4};
    if (i % 3 == 2) e.tip_force_N = {0, -5e-4, 0};
    set.experiments.push_back(e);
  }
  measure(set, {});
  return set;
}

data::MeasurementSet free_shapes_of(const BenchWire& wire, unsigned seed) {
  data::MeasurementSet set = free_wire(8);
  set.title = "a wire beyond the end of a tube, made by a boundary-value solver";
  set.instruments = {
      {"wire", 1.5, 0.178 * mm, 0, {section(0, 1500, wire.declared_EI, wire.declared_GJ, 7e-4, 0, 0.178, 0)}}};
  for (std::size_t i = 0; i < set.experiments.size(); ++i)
    set.experiments[i].set[0].inserted_m = 0.09 + 0.1 * std::fmod(0.618 * static_cast<double>(i + seed), 1);
  Truth truth;
  truth.stiffness_scale = {{wire.EI / wire.declared_EI}};
  truth.sigma_m = *set.imaging.noise_sigma_m, truth.seed = seed;
  measure(set, truth);
  return set;
}

data::MeasurementSet two_tubes(int experiments) {
  data::MeasurementSet set;
  set.title = "two tubes, made by a boundary-value solver", set.source = "tests";
  set.instruments = {
      {"outer",
       0.14,
       1.65 * mm,
       1.4 * mm,
       {section(0, 50, 5500, 3900, 3e-3, 0.0136, 1.65, 1.4), section(50, 140, 5500, 3900, 3e-3, 0, 1.65, 1.4)}},
      {"inner",
       0.22,
       1.32 * mm,
       1.07 * mm,
       {section(0, 50, 2650, 1900, 2e-3, 0.0127, 1.32, 1.07), section(50, 220, 2650, 1900, 2e-3, 0, 1.32, 1.07)}}};
  set.imaging.noise_sigma_m = 0.3 * mm;
  set.imaging.registration_free = set.imaging.tip_offset_free = true;
  for (int i = 0; i < experiments; ++i) {
    data::Experiment e;
    e.id = "p" + std::to_string(i);
    e.place = "experiments[" + std::to_string(i) + "]";
    const double a = 0.055 + 0.035 * std::fmod(0.618 * i, 1), b = a + 0.005 + 0.03 * std::fmod(0.414 * i, 1);
    e.set = {{a, 1.2 * std::sin(2.1 * i), 0.14 - a}, {b, 1.3 * std::cos(1.3 * i), 0.22 - b}};
    e.specimen.resize(2);
    e.kind = data::Experiment::Kind::tip;
    set.experiments.push_back(e);
  }
  measure(set, {});
  return set;
}

namespace {

using Json = nlohmann::ordered_json;

Json vector(const Vector3d& v, double unit) { return {v.x() / unit, v.y() / unit, v.z() / unit}; }

Json views_of(const data::MeasurementSet& set) {
  Json out = Json::array();
  for (const data::MeasuredCArm& arm : set.views)
    out.push_back({{"id", arm.id},
                   {"source_mm", vector(arm.camera.source_m, mm)},
                   {"pixel_0_0_mm", vector(arm.camera.pixel_0_0_m, mm)},
                   {"u", vector(arm.camera.u, 1)},
                   {"v", vector(arm.camera.v, 1)},
                   {"pixel_mm", arm.camera.pixel_m / mm},
                   {"columns", arm.camera.columns},
                   {"rows", arm.camera.rows}});
  return out;
}

}  // namespace

std::string to_json(const data::MeasurementSet& set) {
  const bool seen = !set.views.empty();
  Json file = {{"schema", seen ? "ostium-measurement/2" : "ostium-measurement/1"}};
  if (seen) file["kind"] = "projections";
  file["title"] = set.title, file["source"] = set.source;
  for (const data::MeasuredInstrument& i : set.instruments) {
    Json sections = Json::array();
    for (const core::Section& s : i.sections)
      sections.push_back(
          {{"from_tip_mm", {s.from_tip_m / mm, s.to_tip_m / mm}},
           {"EI_Nmm2", s.EI1_N_m2 / Nmm2},
           {"GJ_Nmm2", s.GJ_N_m2 / Nmm2},
           {"kg_per_mm", s.kg_per_m * mm},
           {"rest_curvature_per_mm", {s.rest_curvature_per_m.x() * mm, s.rest_curvature_per_m.y() * mm}}});
    file["instruments"].push_back({{"name", i.name},
                                   {"total_length_mm", i.length_m / mm},
                                   {"outer_radius_mm", i.radius_m / mm},
                                   {"inner_radius_mm", i.inner_radius_m / mm},
                                   {"sections", sections}});
  }
  file["environment"] = {{"gravity_m_s2", vector(set.gravity_m_s2, 1)}, {"vessel", nullptr}};
  if (set.vessel)
    file["environment"]["vessel"] = {
        {"mesh", set.vessel->mesh}, {"units", set.vessel->units}, {"friction", set.vessel->friction}};
  const std::string noise = "noise_sigma_" + set.unit().name;
  file["imaging"] = {{noise, nullptr}};
  if (set.imaging.noise_sigma_m) file["imaging"][noise] = *set.imaging.noise_sigma_m / set.unit().size;
  if (seen) {
    file["imaging"]["views"] = "given";
    file["views"] = views_of(set);
  } else {
    file["imaging"]["registration"] = set.imaging.registration_free ? "free" : "given";
    file["imaging"]["tip_offset"] = set.imaging.tip_offset_free ? "free" : "none";
  }
  for (const data::Experiment& e : set.experiments) {
    const Eigen::Matrix3d R = Eigen::Quaterniond(e.base.q_W[0], e.base.q_W[1], e.base.q_W[2], e.base.q_W[3]).matrix();
    Json entry = {
        {"id", e.id},
        {"base",
         {{"position_mm", vector(e.base.p_W, mm)}, {"tangent", vector(R.col(2), 1)}, {"up", vector(R.col(0), 1)}}},
        {"set", Json::array()},
        {"tip_force_N", vector(e.tip_force_N, 1)}};
    if (e.proximal_force_N) entry["proximal_force_N"] = *e.proximal_force_N;
    for (const data::Placement& p : e.set)
      entry["set"].push_back({{"inserted_length_mm", p.inserted_m / mm},
                              {"roll_deg", p.roll_rad * 180 / pi},
                              {"shaft_mm", p.shaft_m / mm}});
    if (!e.group.empty()) entry["group"] = e.group;
    if (e.elapsed_s) entry["elapsed_s"] = *e.elapsed_s;
    if (e.kind == data::Experiment::Kind::tip) entry["tip_mm"] = vector(e.points_m[0], mm);
    if (e.kind == data::Experiment::Kind::centreline)
      for (const Vector3d& p : e.points_m) entry["centreline_mm"].push_back(vector(p, mm));
    for (const data::ClickedPolyline& polyline : e.polylines) {
      Json points = Json::array();
      for (const Eigen::Vector2d& p : polyline.points_px) points.push_back({p.x(), p.y()});
      entry["projections"].push_back({{"view", set.views[polyline.view].id}, {"polyline_px", points}});
    }
    if (e.kind == data::Experiment::Kind::radius) entry["radius_of_curvature_mm"] = e.radius_m / mm;
    file["experiments"].push_back(entry);
  }
  return file.dump(1);
}

std::string write_set(const std::string& folder, const data::MeasurementSet& set) {
  const std::string file = folder + "/measurement.json";
  data::write_file(file, to_json(set));
  if (set.vessel)
    data::write_mesh(folder + "/" + set.vessel->mesh, {set.vessel->wall->frames[0], set.vessel->wall->triangles},
                     vascular::LengthUnit::metre);
  return file;
}

}  // namespace ostium::synthetic
