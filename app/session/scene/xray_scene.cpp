#include "app/session/scene/xray_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/angiography/device_scene.h"
#include "app/angiography/xray_body.h"
#include "core/base/units.h"
#include "core/rod/introducer.h"
#include "data/formats/load_error.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/shapes.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr float iodine_kg_m3 = 350;

fluoro::Material material_of(data::OpaqueMaterial material) {
  switch (material) {
    case data::OpaqueMaterial::polymer:
      return fluoro::Material::polymer;
    case data::OpaqueMaterial::steel:
      return fluoro::Material::steel;
    case data::OpaqueMaterial::nitinol:
      return fluoro::Material::nitinol;
    case data::OpaqueMaterial::cobalt_chromium:
      return fluoro::Material::cobalt_chromium;
    case data::OpaqueMaterial::platinum:
      return fluoro::Material::platinum;
    case data::OpaqueMaterial::tungsten:
      return fluoro::Material::tungsten;
    case data::OpaqueMaterial::gold:
      return fluoro::Material::gold;
    case data::OpaqueMaterial::barium_sulphate:
      return fluoro::Material::polymer_barium;
  }
  return fluoro::Material::polymer;
}

/// Volume share of barium sulphate in fluoro's barium-filled polymer: a quarter of the mass of 1330 kg/m3, at 4500.
constexpr double barium_share = 0.25 * 1330 / 4500;

/// The material's cross-section (thickness times diameter), spread over the ring between lumen and surface, as braids
/// and fillings are; in a wire it is a central core. If there is more material than room, it is denser than solid.
fluoro::OpaqueSection section(const data::Instrument& instrument, double from_m, double to_m,
                              data::OpaqueMaterial material, double thickness_m) {
  const double outer = 0.5 * instrument.outer_diameter_m, inner = 0.5 * instrument.inner_diameter_m;
  double area = thickness_m * instrument.outer_diameter_m;
  if (material == data::OpaqueMaterial::barium_sulphate) area /= barium_share;
  const double radius = inner > 0 ? outer : std::min(outer, std::sqrt(area / units::pi));
  const double ring = units::pi * (radius * radius - inner * inner);
  return {from_m, to_m, material_of(material), radius, inner, ring > 0 ? area / ring : 0};
}

/// A marker band. One that has a diameter of its own lies on an inner tube, and is seen denser and narrower than the
/// same metal spread over the folds round it.
fluoro::OpaqueSection section(const data::Instrument& instrument, const data::Marker& marker) {
  const double from_m = marker.from_tip_m, to_m = marker.from_tip_m + marker.length_m;
  if (!marker.outer_diameter_m) return section(instrument, from_m, to_m, marker.material, marker.thickness_m);
  const double outer = 0.5 * *marker.outer_diameter_m, area = marker.thickness_m * *marker.outer_diameter_m;
  return {from_m, to_m, material_of(marker.material), outer, std::sqrt(std::max(0.0, outer * outer - area / units::pi)),
          1};
}

/// Sets the contrast in a guide's bore from the line's cells (contrast.h), those of the catheter.
void fill_bore(const SessionModel& model, const SessionState& state, const core::Rod& rod, fluoro::Shaft& shaft) {
  const vascular::Line line = line_of(model.tools[static_cast<std::size_t>(state.coupling.guide)].instrument);
  const double cell_m3 = line.dead_m3 / vascular::line_cells, area = units::pi * line.bore_m * line.bore_m;
  shaft.lumen_iodine_kg_m3 = Eigen::VectorXd(shaft.p_P.cols());
  for (Eigen::Index i = 0; i < shaft.p_P.cols(); ++i) {
    const double from_tip = rod.node_from_tip_m[static_cast<std::size_t>(rod.elements - i)];
    const int cell =
        std::clamp(vascular::line_cells - 1 - static_cast<int>(from_tip * area / cell_m3), 0, vascular::line_cells - 1);
    shaft.lumen_iodine_kg_m3[i] = state.blood.contrast.line_kg[static_cast<std::size_t>(cell)] / cell_m3;
  }
}

bool was_filled(const SessionState& state, int place) {
  return place >= 0 && state.treatment.balloons[static_cast<std::size_t>(place)].was_filled;
}

/// Whether the stent must be drawn strut by strut, because its balloon was filled; the catalogue's opaque stretch is
/// for the crimped stent.
bool has_left_its_stent(const SessionModel& model, const SessionState& state, std::size_t tool) {
  const int balloon = model.balloon_of[tool];
  if (balloon < 0) return false;
  const int stent = model.treatment.stent_on[static_cast<std::size_t>(balloon)];
  if (stent < 0) return false;
  return state.treatment.stents[static_cast<std::size_t>(stent)].where != vascular::StentState::on_balloon ||
         was_filled(state, place_of(state.coupling, static_cast<int>(tool)));
}

}  // namespace

std::vector<double> occupied_m(const SessionModel& model, const SessionState& state) {
  std::vector<double> out = state.coupling.shaft_m;
  for (std::size_t n = 0; n < state.coupling.balloons.size(); ++n) {
    const CoupledBalloon& b = state.coupling.balloons[n];
    if (b.balloon < 0 || b.branch < 0) continue;
    const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(b.branch)];
    for (std::size_t k = 0; k < path.cells.size(); ++k) {
      double& own = out[static_cast<std::size_t>(path.cells[k])];
      own = std::max(own, radius_at(model.treatment.balloons[static_cast<std::size_t>(b.balloon)],
                                    state.treatment.balloons[n], path.s_m[k]));
    }
  }
  return out;
}

void add_treatment(const SessionModel& model, const SessionState& state, fluoro::Scene& scene) {
  const Coronaries& c = *model.vessel->coronaries;
  const vascular::LumenMoment at = moment(model, state);
  const auto path_of = [&](double branch) -> const vascular::VesselPath& {
    return model.treatment.paths[static_cast<std::size_t>(branch)];
  };
  for (std::size_t i = 0; i < state.treatment.stents.size(); ++i) {
    const vascular::StentState& stent = state.treatment.stents[i];
    if (stent.branch < 0) continue;
    std::function<Eigen::Vector2d(double)> aside_m;
    bool opening = false;
    for (std::size_t k = 0; k < state.coupling.balloons.size(); ++k) {
      const CoupledBalloon& b = state.coupling.balloons[k];
      const vascular::BalloonState& balloon = state.treatment.balloons[k];
      if (stent.where != vascular::StentState::on_balloon || b.balloon < 0 || b.branch < 0 || !balloon.was_filled ||
          model.treatment.stent_on[static_cast<std::size_t>(b.balloon)] != static_cast<int>(i))
        continue;
      opening = true;
      aside_m = [its = &model.treatment.balloons[static_cast<std::size_t>(b.balloon)], own = &balloon](double s_m) {
        return aside_at_m(*its, *own, s_m);
      };
    }
    if (opening || stent.where == vascular::StentState::deployed)
      add_stent(model.treatment.stents[i], stent, path_of(stent.branch), *c.patient, c.map, *c.shape,
                state.blood.radius_m, at, aside_m, scene);
  }
  for (std::size_t k = 0; k < state.coupling.balloons.size(); ++k)
    if (const CoupledBalloon& b = state.coupling.balloons[k]; b.balloon >= 0 && b.branch >= 0)
      add_balloon(model.treatment.balloons[static_cast<std::size_t>(b.balloon)], state.treatment.balloons[k],
                  path_of(b.branch), c.map, at, false, scene);  // its shaft draws the markers
  add_pools(state.treatment.injury, c.map, state.blood.radius_m, at, scene);
}

std::vector<fluoro::OpaqueSection> sections_of(const data::Instrument& instrument, bool stent_left) {
  std::vector<fluoro::OpaqueSection> sections;
  for (const data::OpaqueStretch& o : instrument.opaque)
    if (!stent_left || o.material != data::OpaqueMaterial::cobalt_chromium)
      sections.push_back(section(instrument, o.from_tip_m, o.to_tip_m, o.material, o.thickness_m));
  for (const data::Marker& m : instrument.markers) sections.push_back(section(instrument, m));
  return sections;
}

std::vector<fluoro::Shaft> shafts_of(const SessionModel& model, const SessionState& state) {
  std::vector<fluoro::Shaft> shafts;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& s = state.rods.rods[t];
    if (!in_body(rod, s)) continue;
    const int first = s.first, count = rod.nodes() - first;
    if (count < 2) continue;
    const data::Instrument& instrument = model.tools[t].instrument;
    fluoro::Shaft shaft{.name = model.tools[t].name,
                        .p_P = Eigen::Matrix3Xd(3, count),
                        .sections = {},
                        .lumen_radius_m = 0.5 * instrument.inner_diameter_m,
                        .lumen_iodine_kg_m3 = {}};
    shaft.v_P.resize(3, count);
    for (int i = 0; i < count; ++i)
      shaft.p_P.col(i) = s.position[rod.elements - i], shaft.v_P.col(i) = s.velocity[rod.elements - i];
    if (static_cast<int>(t) == state.coupling.guide) fill_bore(model, state, rod, shaft);
    const bool stent_left = has_left_its_stent(model, state, t);
    shaft.sections = sections_of(instrument, stent_left);
    shafts.push_back(std::move(shaft));
  }
  return shafts;
}

XrayPatient::XrayPatient(std::shared_ptr<const vascular::Patient> patient, Fill which, bool breathes)
    : patient_(std::move(patient)), breathes_(breathes) {
  auto fixed = std::make_shared<std::vector<fluoro::Body>>();
  for (vascular::XrayBody& body : make_thorax(patient_->anatomy)) {
    if (body.beat.empty() && !(breathes && !body.breath.empty())) {
      fixed->push_back(body_of(body));
    } else {
      moving_bodies_.push_back(body_of(body));
      set_still(body, breathes, moving_bodies_.back());
      moving_.push_back(std::move(body));
    }
  }
  fixed_ = std::move(fixed);
  if (which != Fill::none) fill(which);
}

/// A coronary tree, closed by a lid at its ostium.
void XrayPatient::fill(Fill which) {
  const vascular::Anatomy& anatomy = patient_->anatomy;
  std::vector<bool> coronary(anatomy.tubes.size(), false);
  const char* const name = which == Fill::left ? "LM" : "RCA";
  const vascular::NamedBranch* trunk = find_branch(anatomy, name);
  if (!trunk) throw data::LoadError(fmt::format("--fill: this patient has no {}, which would be filled", name));
  coronary[static_cast<std::size_t>(trunk->tube)] = true;
  for (std::size_t t = 0; t < anatomy.tubes.size(); ++t)
    if (anatomy.tubes[t].parent >= 0 && coronary[static_cast<std::size_t>(anatomy.tubes[t].parent)]) coronary[t] = true;
  const vascular::MovingLumen& lumen = patient_->lumen;
  const auto belongs = [&](int v) {
    double weight = 0;
    for (const vascular::TubeShare& share : lumen.shares[static_cast<std::size_t>(v)])
      if (coronary[static_cast<std::size_t>(share.tube)]) weight += share.weight;
    return weight > 0.5;
  };
  filled_ = cut_out(lumen.triangles, lumen.vertices(),
                    [&](const Corners& t) { return belongs(t[0]) && belongs(t[1]) && belongs(t[2]); });
  twigs_.emplace(std::make_shared<const vascular::Twigs>(grow_twigs(*patient_)));
  twigs_->fill([&](int root) { return belongs(root) ? iodine_kg_m3 : 0; });
}

fluoro::Scene XrayPatient::at(double phase, double breath_depth) const {
  const double breath = breathes_ ? breath_depth : 0;
  fluoro::Scene scene{fixed_, moving_bodies_, {}};
  for (std::size_t b = 0; b < moving_.size(); ++b)
    move(moving_[b], vascular::contraction(phase), breath, scene.moving[b]);
  if (filled_.vertices.empty()) return scene;
  const vascular::Mesh lumen = patient_->lumen.at(phase, breath);
  fluoro::Body body{.name = "contrast",
                    .triangles = filled_.triangles,
                    .p_P = {},
                    .tissue = fluoro::tissue::blood,
                    .within = fluoro::tissue::blood,
                    .contrast = {}};
  take(filled_, points_of(lumen.vertices), body.p_P);
  // The concentration is uniform, so depths may be counted from any common origin.
  body.contrast.iodine_kg_m3 = Eigen::VectorXf::Constant(body.p_P.cols(), iodine_kg_m3);
  body.contrast.p_PC = body.p_P.col(0).replicate(1, body.p_P.cols());
  scene.moving.push_back(std::move(body));
  if (!twigs_->empty()) scene.moving.push_back(twigs_->at(patient_->lumen, phase, breath));
  return scene;
}

CaseScene scene_of_case(const data::Case& c, Fill fill, Vector3d& middle) {
  const auto patient = std::make_shared<const vascular::Patient>(patient_of(c));
  const auto xray = std::make_shared<const XrayPatient>(patient, fill);
  middle = heart_middle(*patient);
  return {[xray](double phase) { return xray->at(phase); },
          [rate = c.rate_1_min](double phase, double seconds) {
            for (double t = 0; t < seconds; t += 1e-3)
              phase += std::min(1e-3, seconds - t) * vascular::phase_speed(phase, rate);
            return phase - std::floor(phase);
          }};
}

fluoro::Scene scene_of_mesh(const Vessel& vessel) {
  Vector3d low = vessel.wall.frames[0][0], high = low;
  for (const Vector3d& p : vessel.wall.frames[0]) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vector3d middle = vessel.p_middle,
                 half = (0.5 * (high - low)).cwiseMax(Vector3d::Constant(0.09)) + Vector3d::Constant(0.02);
  const fluoro::phantom::Surface block = fluoro::phantom::brick(middle - half, middle + half);
  const auto fixed = std::make_shared<const std::vector<fluoro::Body>>(std::vector<fluoro::Body>{
      fluoro::phantom::body("block of soft tissue", block, fluoro::tissue::soft, fluoro::tissue::air)});
  return {fixed, {}, {}};
}

}  // namespace ostium::app
