#include "app/session/coupling/coupling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/session/coupling/device_constraints.h"
#include "app/session/coupling/looks.h"
#include "app/session/coupling/tool_geometry.h"
#include "core/base/units.h"
#include "data/assessment/metrics.h"
#include "data/formats/load_error.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double manifold_m3 = 0.3e-6;  // of the line ahead of the guide

}  // namespace

CouplingState make_coupling(const Vessel& vessel) {
  CouplingState state;
  if (vessel.coronaries) state.shaft_m.assign(vessel.coronaries->tree().cells.size(), 0);
  for (CoupledBalloon& own : state.balloons)
    own.aside_m.assign(vascular::balloon_spheres, Eigen::Vector2d::Zero()), own.bend_1_m = own.aside_m;
  return state;
}

CouplingScratch::CouplingScratch(const Vessel& vessel) : locator(vessel.coronaries->map, vessel.coronaries->tree()) {
  points.reserve(1000);
}

vascular::Line line_of(const data::Instrument& guide) {
  vascular::Line line;
  line.bore_m = guide.inner_diameter_m / 2, line.length_m = guide.length_m;
  line.dead_m3 = manifold_m3 + units::pi * line.bore_m * line.bore_m * line.length_m;
  return line;
}

namespace {

double radius_of(const data::Instrument& instrument, double from_tip_m) {
  for (const core::Section& section : instrument.sections)
    if (section.from_tip_m <= from_tip_m && from_tip_m < section.to_tip_m) return section.radius_m;
  return instrument.outer_diameter_m / 2;
}

/// Radius of what lies between its markers: of a folded balloon, its profile.
double radius_between_markers(const data::Instrument& instrument) {
  return radius_of(instrument, (marker_from_tip_m(instrument, 0) + marker_from_tip_m(instrument, 1)) / 2);
}

}  // namespace

std::vector<int> add_devices(const std::vector<SessionTool>& tools, std::uint64_t seed,
                             vascular::TreatmentModel& model) {
  std::vector<int> balloon_of;
  for (const SessionTool& tool : tools) {
    balloon_of.push_back(-1);
    if (!tool.instrument.balloon) continue;
    const data::CarriedBalloon& carried = *tool.instrument.balloon;
    vascular::BalloonModel balloon =
        make_balloon(carried.compliant ? vascular::Compliance::semi : vascular::Compliance::non, carried.nominal_m,
                     carried.length_m, carried.design);
    balloon.name = tool.instrument.title;
    balloon.nominal_Pa = carried.nominal_Pa, balloon.rated_Pa = carried.rated_Pa;
    balloon.seed = seed + model.balloons.size() + 1;
    balloon.tip_m = marker_from_tip_m(tool.instrument, 1);
    balloon.tip_radius_m = std::max(radius_of(tool.instrument, 0), radius_between_markers(tool.instrument));
    // Under a stent it is as small as the makers' own balloons are; without one it is what its shaft shows.
    if (!tool.instrument.stent && !carried.own_folds) {
      const double larger_m = balloon.refolded_m - balloon.folded_m;
      balloon.folded_m = radius_between_markers(tool.instrument);
      balloon.refolded_m = balloon.folded_m + larger_m;
    }
    int on = -1;
    try {
      if (tool.instrument.stent) {
        on = static_cast<int>(model.stents.size());
        const data::CarriedStent& stent = *tool.instrument.stent;
        model.stents.push_back(make_stent(stent.nominal_m, stent.length_m, stent.design));
        check(model.stents.back());
      }
      check(balloon);
    } catch (const std::invalid_argument& error) {
      throw data::LoadError(fmt::format("{} ({}): {}", tool.name, tool.instrument.name, error.what()));
    }
    balloon_of.back() = static_cast<int>(model.balloons.size());
    model.balloons.push_back(balloon), model.stent_on.push_back(on);
  }
  return balloon_of;
}

int place_of(const CouplingState& state, int tool) {
  for (int k = 0; k < vascular::most_balloons; ++k)
    if (tool >= 0 && state.balloons[k].tool == tool) return k;
  return -1;
}

BalloonInBody balloon_in_body(const CouplingState& state, const vascular::TreatmentState& treatment,
                              const DeliveryInputs& inputs, int nth) {
  const int place = nth == 0 ? state.first : vascular::most_balloons - 1 - state.first;
  if (state.balloons[place].tool < 0) return {};
  return {&state.balloons[place], &treatment.balloons[place], nth == 0 ? inputs.gauge_Pa : inputs.second_gauge_Pa};
}

void look(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
          const core::StepReport& report, const vascular::LumenMoment& moment, CouplingScratch& x, CouplingState& s) {
  x.locator.set_moment(moment);
  const vascular::Landmarks& marks = model.vessel.patient->anatomy.landmarks;
  const vascular::HeartMotion motion(marks);
  const Vector3d root_shift = vascular::contraction(moment.phase) * motion.root_displacement() +
                              motion.breath_displacement(marks.p_annulus, moment.breath);
  look_at_shafts(model, rods, x, s);
  look_at_balloons(model, rods, treatment, report, moment, x, s);
  look_at_guide(model, rods, report, moment, root_shift, x, s);
  look_at_crimped_stents(model, rods, treatment, s);
  look_at_edge(model, rods, treatment, x, s);
  look_at_wires(model, rods, report, root_shift, x, s);
  look_at_valve(model, rods, report, moment, root_shift, s);
}

void press_with_wire(const CouplingModel& model, const core::StepReport& report, double step_s, CouplingState& s) {
  double now_N = 0;
  for (std::size_t t = 0; t < model.tools.size() && s.wire_cell >= 0; ++t)
    if (is_thin_wire(model.tools[t].instrument))
      now_N = std::max(now_N, tip_force_N(model, report, static_cast<int>(t)));
  const double share = 1 - std::exp(-2 * units::pi * data::wall_force_cut_off_Hz * step_s);
  s.wire_tip_N += share * (now_N - s.wire_tip_N);
  if (s.wire_tip_N < 1e-6) s.wire_tip_N = 0;
}

void forget_what_is_given_once(DeliveryInputs& inputs) {
  inputs.heparin_U = inputs.nitrate_ug = inputs.adenosine_ug = inputs.drug_dose = inputs.shock_J = 0;
  inputs.drug = inputs.provoked_cell = -1, inputs.provoked = 0, inputs.provoked_size = 0;
}

double drawn_m3_s(const CouplingModel& model, const DeliveryInputs& inputs, const CouplingState& s) {
  if (s.guide < 0 || inputs.injection_m3_s > 0 || inputs.aspiration_m3_s <= 0) return 0;
  const data::Instrument& guide = model.tools[static_cast<std::size_t>(s.guide)].instrument;
  return vascular::drawn_m3_s(inputs.aspiration_m3_s, line_of(guide), s.filled_m);
}

vascular::TreatmentInputs treatment_inputs(const CouplingModel& model, const core::State& rods,
                                           const vascular::TreatmentState& treatment, const DeliveryInputs& inputs,
                                           const vascular::LumenMoment& moment, const CouplingState& s) {
  vascular::TreatmentInputs out;
  for (int k = 0; k < vascular::most_balloons; ++k) {
    const CoupledBalloon& own = s.balloons[k];
    const vascular::BalloonState& body = treatment.balloons[k];
    const double shaft_m = own.branch >= 0 && body.held && treatment.balloon_in[k] == own.balloon
                               ? body.seat_m - ahead_of_shaft_m(model, rods, body, own, moment)
                               : own.middle_m;
    out.balloons[k] = {.balloon = own.balloon,
                       .branch = own.branch,
                       .shaft = {shaft_m, own.aside_m, own.bend_1_m, std::numeric_limits<double>::infinity()},
                       .gauge_Pa = k == s.first ? inputs.gauge_Pa : inputs.second_gauge_Pa,
                       .drag_N = own.drag_N + own.caught_N};
  }
  out.edge_m = s.edge_m, out.edge_N = s.edge_N;
  out.wire_tip_cell = s.wire_cell;
  out.wire_tip_N = s.wire_tip_N;
  out.shaft_m = s.shaft_m;
  out.doses = {inputs.heparin_U, inputs.nitrate_ug, inputs.adenosine_ug, inputs.drug, inputs.drug_dose};
  const int kind = std::clamp(inputs.provoked, 0, vascular::provocations - 1);
  out.provocation = {static_cast<vascular::Provoked>(kind), inputs.provoked_cell, inputs.provoked_size};
  out.shock_J = inputs.shock_J;
  out.tip = s.tip, out.drawn_m3_s = drawn_m3_s(model, inputs, s);
  out.tip_covered = s.covered, out.injected_m3_s = s.guide < 0 ? 0 : inputs.injection_m3_s;
  return out;
}

void set_physiology_inputs(const CouplingModel& model, const DeliveryInputs& inputs, const CouplingState& s,
                           vascular::PhysiologyInputs& to) {
  to.contrast.injection_m3_s = s.guide < 0 ? 0 : inputs.injection_m3_s;
  to.contrast.iodine_kg_m3 = inputs.iodine_kg_m3;
  to.contrast.aspiration_m3_s = s.guide < 0 ? 0 : inputs.aspiration_m3_s;
  to.contrast.shaft_m = s.filled_m;
  to.contrast.tip = s.tip;
  if (s.guide >= 0) to.contrast.line = line_of(model.tools[static_cast<std::size_t>(s.guide)].instrument);
  to.tip_in_ventricle = s.in_ventricle, to.wire_in_catheter = s.thick_wire;
  to.tip_covered = s.covered;
}

}  // namespace ostium::app
