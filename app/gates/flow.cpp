/// Blood flow against closed forms and published velocities; the pressures of a beat, and the ECG in ischaemia.
#include <algorithm>
#include <cmath>

#include "app/angiography/settle.h"
#include "app/gates/gate.h"
#include "core/base/units.h"
#include "vascular/physiology/physiology.h"

namespace ostium::app::gates {

namespace {

using units::mmHg;

using units::pi;

struct Steady {
  vascular::FlowModel model;
  vascular::FlowState state;
  std::vector<double> radius_m;
  static constexpr vascular::Pressures p{93 * mmHg, 0};

  explicit Steady(const std::vector<vascular::PlainBranch>& branches) : model(make_flow_model(plain_tree(branches))) {
    for (const vascular::FlowCell& cell : model.tree.cells) radius_m.push_back(cell.healthy_m);
    // Constant muscle resistance: autoregulation is tested elsewhere.
    model.tone_s = 1e12;
    state = make_flow_state(model);
  }
  void run(int steps = 40) {
    vascular::FlowScratch scratch;
    for (int i = 0; i < steps; ++i) step(model, {p, radius_m, {}, 0}, 8e-3, state, scratch);
  }
};

data::GateResult poiseuille() {
  constexpr double L = 0.1, r = 1.5e-3;
  Steady tube({{-1, 100, L / 100, r}});
  tube.run();
  const double Q = tube.state.flow_m3_s.back();
  const double reference = 8 * tube.model.viscosity_Pa_s * L * Q / (pi * std::pow(r, 4));
  return {"flow-poiseuille", (tube.p.aorta_Pa - tube.state.pressure_Pa.back()) / mmHg, reference / mmHg,
          1e-6 * reference / mmHg, "mmHg"};
}

/// Two tubes branching from one: flows are in the ratio of the conductances of tube and muscle.
data::GateResult y_split() {
  constexpr double r1 = 1.2e-3, r2 = 0.8e-3, L1 = 40e-3, L2 = 60e-3;
  Steady y({{-1, 30, 1e-3, 1.5e-3}, {0, 40, L1 / 40, r1}, {0, 60, L2 / 60, r2}});
  y.run();
  const auto& b = y.model.tree.branches;
  const auto resistance = [&](int branch, double L, double r) {
    return 8 * y.model.viscosity_Pa_s * L / (pi * std::pow(r, 4)) + 1 / y.model.leak_m3_sPa[b[branch].last - 1];
  };
  const double reference = resistance(2, L2, r2) / resistance(1, L1, r1);
  return {"flow-y-split", y.state.flow_m3_s[b[1].first] / y.state.flow_m3_s[b[2].first], reference, 1e-9 * reference,
          "1"};
}

/// An abrupt stenosis of 70 % of the diameter in a tube: Young and Tsai's loss behind it, Poiseuille's in it.
data::GateResult stenosis() {
  constexpr double r0 = 1.5e-3, rs = 0.45e-3, dx = 0.5e-3;
  constexpr int cells = 100, from = 40, to = 50;
  Steady tube({{-1, cells, dx, r0}});
  for (int c = from; c < to; ++c) tube.radius_m[c] = rs;
  tube.run(400);
  const double Q = tube.state.flow_m3_s.back(), As = pi * rs * rs, A = pi * r0 * r0;
  const double viscous = 8 * tube.model.viscosity_Pa_s * Q / pi *
                         ((cells - to + from) * dx / std::pow(r0, 4) + (to - from) * dx / std::pow(rs, 4));
  const double reference =
      viscous + tube.model.separation * tube.model.density_kg_m3 / 2 * std::pow(1 / As - 1 / A, 2) * Q * Q;
  return {"flow-stenosis", (tube.p.aorta_Pa - tube.state.pressure_Pa.back()) / mmHg, reference / mmHg,
          1e-3 * reference / mmHg, "mmHg"};
}

struct Beat {
  double systolic = 0, diastolic = 0, mean = 0;  // peak section-mean velocities, m/s
};

Beat velocities(const vascular::PhysiologyModel& model, vascular::PhysiologyState state, const char* branch,
                double rate) {
  const vascular::FlowBranch& b = model.flow.tree.branches[model.flow.tree.branch(branch)];
  const int cell = b.first + 5;
  const double area = pi * std::pow(state.radius_m[cell], 2);
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  inputs.heart.rate_1_min = rate;
  Beat out;
  constexpr int steps = 6000;
  for (int n = 0; n < steps; ++n) {
    step(model, inputs, 1e-3, state, scratch);
    const double u = state.flow.flow_m3_s[cell] / area, phase = state.heart.phase;
    double& peak = phase > 0.06 && phase < 0.34 ? out.systolic : out.diastolic;
    if (phase < 0.34 || phase > 0.42) peak = std::max(peak, u);
    out.mean += u / steps;
  }
  return out;
}

void add_pressures(const vascular::PhysiologyModel& model, vascular::PhysiologyState state,
                   std::vector<data::GateResult>& out) {
  double low = 1e9, high = 0, sum = 0;
  vascular::PhysiologyScratch scratch;
  constexpr int steps = 8571;
  for (int n = 0; n < steps; ++n) {
    step(model, {}, 1e-3, state, scratch);
    const double p = pressures(model.heart, state.heart).aorta_Pa;
    low = std::min(low, p), high = std::max(high, p), sum += p / steps;
  }
  // 120/80, mean 93: from memory; +-10 is what any textbook calls normal.
  out.push_back({"flow-aorta-systolic", high / mmHg, 120, 10, "mmHg"});
  out.push_back({"flow-aorta-diastolic", low / mmHg, 80, 10, "mmHg"});
  out.push_back({"flow-aorta-mean", sum / mmHg, 93, 5, "mmHg"});
}

/// The LAD is closed by a balloon for a minute, then opened.
void add_ischaemia(const vascular::PhysiologyModel& model, vascular::PhysiologyState state,
                   std::vector<data::GateResult>& out) {
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  const vascular::FlowBranch& lad = model.flow.tree.branches[model.flow.tree.branch("LAD")];
  inputs.occupied_m.assign(model.flow.tree.cells.size(), 0);
  inputs.occupied_m[lad.first + 8] = state.radius_m[lad.first + 8];
  double appears = 0, gone = 0;
  const auto shift = [&] { return ST_shift_mV(model.ischaemia, state.ischaemia); };
  for (int n = 0; n < 60000; ++n) {
    step(model, inputs, 1e-3, state, scratch);
    if (appears == 0 && shift() >= 0.1) appears = 1e-3 * n;
  }
  inputs.occupied_m.clear();
  for (int n = 0; n < 90000 && gone == 0; ++n) {
    step(model, inputs, 1e-3, state, scratch);
    if (shift() < 0.1) gone = 1e-3 * n;
  }
  out.push_back({"flow-ST-after-closure", appears, 19, 12, "s"});
  out.push_back({"flow-ST-gone-after-opening", gone, 20, 9, "s"});
}

}  // namespace

std::vector<data::GateResult> flow(bool quick) {
  std::vector<data::GateResult> out = {poiseuille(), y_split(), stenosis()};
  const vascular::Patient patient = vascular::make_patient({}, {});
  const vascular::PhysiologyModel model = make_physiology(patient);
  const vascular::PhysiologyState rest = at_rest(model, 70);
  add_pressures(model, rest, out);
  // Hadjiloizou 2008: left main and right; PMID 16932084: LAD. Doppler measures the centre, twice the mean.
  const Beat lm = velocities(model, rest, "LM", 70), lad = velocities(model, rest, "LAD", 70),
             rca = velocities(model, rest, "RCA", 70);
  out.push_back({"flow-diastolic-to-systolic-LM", lm.diastolic / lm.systolic, 1.79, 0.48, "1"});
  out.push_back({"flow-diastolic-to-systolic-LAD", lad.diastolic / lad.systolic, 2.08, 0.64, "1"});
  out.push_back({"flow-diastolic-to-systolic-RCA", rca.diastolic / rca.systolic, 1.00, 0.32, "1"});
  out.push_back({"flow-peak-diastolic-LAD", 200 * lad.diastolic, 44, 12, "cm/s"});
  if (!quick) add_ischaemia(model, rest, out);
  return out;
}

}  // namespace ostium::app::gates
