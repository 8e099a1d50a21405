#include "app/session/scene/monitor.h"

#include <cmath>

#include "core/base/units.h"

namespace ostium::app {

namespace {

using units::atm, units::mmHg;

void add(fluoro::Strip& strip, double value) {
  constexpr auto kept = static_cast<std::size_t>(Monitor::samples_per_s * monitor_s);
  if (strip.samples.size() == kept) strip.samples.erase(strip.samples.begin());
  strip.samples.push_back(static_cast<float>(value));
}

}  // namespace

void Monitor::listen(const SessionModel& model, const SessionState& state, const SessionInputs& inputs) {
  const auto every = static_cast<std::uint64_t>(std::llround(1 / (samples_per_s * model.step_s())));
  if (!model.has_patient() || state.rods.step % every != 0) return;
  const auto leads = ecg(model.physiology.heart, state.blood.heart, model.physiology.ischaemia, state.blood.ischaemia);
  // With contrast in the line, or a thick wire, there is no pressure trace.
  const bool damped_out = inputs.delivery.injection_m3_s > 0 || state.coupling.thick_wire;
  add(II, leads[static_cast<int>(vascular::Lead::II)]), add(V2, leads[static_cast<int>(vascular::Lead::V2)]);
  add(guide, state.coupling.guide >= 0 && !damped_out ? state.blood.line.reading_Pa / mmHg : 0);
  add(gauge, inputs.delivery.gauge_Pa / atm);
}

}  // namespace ostium::app
