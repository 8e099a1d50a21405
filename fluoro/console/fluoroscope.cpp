#include "fluoro/console/fluoroscope.h"

namespace ostium::fluoro {

namespace {

void begin(const FluoroscopeInput& in, const Programme& programme, FluoroscopeState& state) {
  state.imager.lag = {};  // the held image must not blend into new ones
  if (programme.mode == Mode::fluoroscopy) return;
  state.runs.push_back({in.view, programme, {}, {}});
  state.roadmap = {};
  ++state.dose.cine_runs;
}

}  // namespace

TickReport tick(Imager& imager, const FluoroscopeInput& in, FluoroscopeState& state, DisplayScratch& scratch) {
  require_reachable(in.view.arm);
  check(in.collimator);
  require_rate(in.fluoroscopy_per_s);
  require_rate(in.cine_per_s);
  const Pedals before = state.before;
  state.before = in.pedals;
  if (!in.pedals.any()) return {};

  const Programme programme = in.pedals.cine ? cine(in.cine_per_s) : fluoroscopy(in.fluoroscopy_per_s);
  if (!before.any() || before.cine != in.pedals.cine) begin(in, programme, state);
  TickReport report{true, imager.frame({in.scene, in.view, in.collimator, programme, in.seed}, state.imager)};
  state.dose.add(programme, report.frame.exposure);

  if (in.pedals.cine) state.roadmap.record(in.view, state.imager.lag.shown, in.beat_phase);
  const bool mapped = in.show_roadmap && !in.pedals.cine && state.roadmap.fits(in.view);
  display(mapped ? state.roadmap.over(state.imager.lag.shown, in.beat_phase) : state.imager.lag.shown, imager.exposed(),
          in.view.field_m, {}, scratch, state.live);
  if (in.pedals.cine) {
    state.runs.back().frames.push_back(state.live);
    state.runs.back().exposure = report.frame.exposure;
  }
  return report;
}

void freeze_reference(FluoroscopeState& state) {
  if (!state.live.grey.empty()) state.reference = state.live;
}

}  // namespace ostium::fluoro
