/// Contrast: mass is conserved, it splits like blood, and it is delayed by the dead volume; TIMI frame counts from
/// rendered frames.
#include <algorithm>
#include <cmath>

#include "app/angiography/angiogram.h"
#include "app/angiography/settle.h"
#include "app/gates/gate.h"
#include "core/base/units.h"

namespace ostium::app::gates {

namespace {

using units::mL, units::mL_min, units::mmHg;

/// Mass balance while a balloon closes the LAD during injection and drugs and heart rates change.
data::GateResult balance(const vascular::PhysiologyModel& model, vascular::PhysiologyState state) {
  const vascular::FlowTree& tree = model.flow.tree;
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  double worst = 0;
  for (int n = 0; n < 12000; ++n) {
    const int injection = 1 + n / 4000;
    inputs.contrast.injection_m3_s = n % 4000 < 2500 ? injection * 1.5e-6 : 0;
    inputs.contrast.aspiration_m3_s = n % 4000 > 3000 ? 1e-6 : 0;
    inputs.contrast.tip.where = n < 6000 ? vascular::TipPlace::coronary : vascular::TipPlace::left_sinus;
    inputs.contrast.tip.cell =
        n < 3000 ? tree.branches[tree.branch("LM")].first : tree.branches[tree.branch("LAD")].first + 6;
    inputs.contrast.tip.into_ostium = 0.4;
    inputs.hyperaemia = n > 8000;
    inputs.occupied_m.assign(tree.cells.size(), 0);
    const int shut = tree.branches[tree.branch("LAD")].first + 20;
    if (n > 4500 && n < 7000) inputs.occupied_m[shut] = state.radius_m[shut];
    step(model, inputs, 1e-3, state, scratch);
    if (state.contrast.injected_kg > 0)
      worst = std::max(worst, std::fabs(accounted_kg(state.contrast) / state.contrast.injected_kg - 1));
  }
  return {"contrast-balance", worst, 0, 1e-6, "1"};
}

/// At a Y: iodine into each limb relative to the flow there.
data::GateResult split() {
  const vascular::FlowModel flow = vascular::make_flow_model(
      vascular::plain_tree({{-1, 30, 1e-3, 1.5e-3}, {0, 60, 1e-3, 1.2e-3}, {0, 60, 1e-3, 0.8e-3}}), 40 * mL_min);
  const vascular::ContrastModel model = make_contrast_model(flow);
  vascular::FlowState blood = make_flow_state(flow);
  vascular::FlowScratch flow_scratch;
  std::vector<double> radius;
  for (const vascular::FlowCell& cell : flow.tree.cells) radius.push_back(cell.healthy_m);
  const vascular::FlowInputs lumen{{93 * mmHg, 0}, radius, {}, 0};
  for (int n = 0; n < 50; ++n) step(flow, lumen, 8e-3, blood, flow_scratch);
  vascular::ContrastState s = make_contrast_state(model, flow);
  vascular::ContrastScratch scratch;
  vascular::ContrastInputs in;
  in.tip = {vascular::TipPlace::coronary, 0, 1};
  const int limb = flow.tree.branches[1].first;
  std::vector<double> through(2, 0);
  for (int n = 0; n <= 30; ++n) {
    in.injection_m3_s = n < 200 ? 0.5 * blood.flow_m3_s[0] : 0;
    in.iodine_kg_m3 = 350;
    if (n == 0) std::fill(s.line_kg.begin(), s.line_kg.end(), 350 * in.line.dead_m3 / vascular::line_cells);
    const auto in_limb = [&](int b) {
      double kg = 0;
      const vascular::FlowBranch& branch = flow.tree.branches[b];
      for (int k = 0; k < vascular::layers; ++k)
        for (int c = branch.first; c < branch.last; ++c) kg += s.sheath_kg[k * flow.tree.cells.size() + c];
      return kg;
    };
    step(model, {flow, blood, lumen, 0}, in, 8e-3, s, scratch);
    if (n == 30) through = {in_limb(1), in_limb(2)};  // while it flows in, before any flows out
  }
  const double reference = blood.flow_m3_s[limb] / blood.flow_m3_s[flow.tree.branches[2].first];
  return {"contrast-y-split", through[0] / through[1], reference, 1e-9 * reference, "1"};
}

/// Contrast leaves the tip once the saline ahead of it has.
data::GateResult lag(const vascular::PhysiologyModel& model, vascular::PhysiologyState state) {
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  inputs.contrast.injection_m3_s = 2 * mL;
  inputs.contrast.tip = {vascular::TipPlace::aorta, 3, 0};
  double t = 0;
  // The front is dispersed in the line: use the moment at which half of the flow is contrast.
  for (double before = 0; t < 3; t += 1e-3) {
    step(model, inputs, 1e-3, state, scratch);
    const double out = state.contrast.from_tip_kg - before;
    before = state.contrast.from_tip_kg;
    if (out > 0.5 * 350 * 2 * mL * vascular::circulation_step_s) break;
  }
  return {"contrast-lag", t, 2.5 / 2, 0.02, "s"};
}

}  // namespace

std::vector<data::GateResult> contrast(bool quick) {
  const vascular::Patient patient = vascular::make_patient({}, {});
  const vascular::PhysiologyModel model = make_physiology(patient);
  const vascular::PhysiologyState rest = at_rest(model, 70);
  std::vector<data::GateResult> out = {balance(model, rest), split(), lag(model, rest)};
  if (quick) return out;
  PatientScene scene(patient, model);
  // Gibson 1996; hand injection as in Dodge 1998, at two cardiac phases.
  for (const auto& [artery, frames, deviation] :
       {std::tuple{"LAD", 36.2, 2.6}, std::tuple{"LCx", 22.2, 4.1}, std::tuple{"RCA", 20.4, 3.0}}) {
    double sum = 0;
    for (double phase : {0.4, 0.9}) {
      const TimiCount count = timi_count(model, scene, patient, artery, rest, 70, phase);
      sum += count.reached ? count.frames / 2 : NAN;
    }
    out.push_back({std::string("contrast-timi-") + artery, sum, frames, deviation, "frames"});
  }
  return out;
}

}  // namespace ostium::app::gates
