/// Flow and contrast for one frame; balloon, stent and wall for one step; in the default case.
#include <time.h>

#include <algorithm>
#include <numeric>

#include "app/angiography/settle.h"
#include "app/angiography/textbook_treatment.h"
#include "app/gates/gate.h"
#include "core/base/units.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

using units::atm, units::mL;

double thread_ms() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

void set_times(std::vector<double> times, double quantile, Row& row) {
  row.ms = std::accumulate(times.begin(), times.end(), 0.0) / double(times.size());
  std::sort(times.begin(), times.end());
  row.p999_ms = times[std::min(times.size() - 1, static_cast<std::size_t>(quantile * double(times.size())))];
}

/// Sets the row's gate to the first result with that name.
void set_gate(const std::vector<data::GateResult>& results, const std::string& name, Row& row) {
  for (const data::GateResult& r : results)
    if (r.gate == name) row.gate = {r.gate, r.value, r.unit, r.pass()};
}

}  // namespace

Row circulation_row(bool quick) {
  Row row{.name = "flow-contrast-frame", .gate = {}};
  const data::Case c = data::find_case("rca-mid-focal");
  const vascular::Patient patient = vascular::make_patient(c.anatomy, c.lesions);
  const vascular::PhysiologyModel model = make_physiology(patient);
  vascular::PhysiologyState state = app::at_rest(model, c.rate_1_min, 5);
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  const vascular::FlowTree& tree = model.flow.tree;
  std::vector<double> times;
  for (int frame = 0; frame < (quick ? 30 : 300); ++frame) {
    // One artery after the other.
    inputs.contrast.tip = {vascular::TipPlace::coronary,
                           tree.branches[tree.branch(frame % 60 < 30 ? "LM" : "RCA")].first, 1};
    inputs.contrast.injection_m3_s = 2 * mL;
    const double start = thread_ms();
    for (int n = 0; n < 67; ++n) step(model, inputs, 1e-3, state, scratch);
    times.push_back(thread_ms() - start);
  }
  set_times(times, 1, row);
  set_gate(app::gates::contrast(true), "contrast-balance", row);
  return row;
}

Row treatment_row(bool quick) {
  Row row{.name = "balloon-stent-step", .gate = {}};
  const data::Case c = data::find_case("rca-mid-focal");
  const vascular::Patient patient = vascular::make_patient(c.anatomy, c.lesions);
  const vascular::PhysiologyModel physiology = make_physiology(patient);
  const app::Treatable t = app::plan_treatment(patient, physiology.flow, 0);
  vascular::PhysiologyState blood = make_state(physiology);
  vascular::TreatmentState state = make_state(t.model, physiology.flow.tree);
  vascular::TreatmentScratch scratch;
  std::vector<double> occupied, times;
  const app::Plan& plan = t.plans.front();
  vascular::TreatmentInputs device;
  device.balloons[0].branch = plan.branch, device.balloons[0].shaft.middle_m = plan.middle_m,
  device.balloons[0].balloon = plan.stent;
  for (int n = 0; n < (quick ? 1000 : 10000); ++n) {
    device.balloons[0].gauge_Pa = std::min(plan.stent_Pa, 2e-3 * atm * n);
    const double start = thread_ms();
    step(t.model, device, 1e-3, state, {physiology.flow, blood, occupied}, scratch);
    times.push_back(thread_ms() - start);
  }
  set_times(times, 0.999, row);
  set_gate(app::gates::treatment(true), "treatment-balloon-chart-semi", row);
  return row;
}

}  // namespace ostium::bench
