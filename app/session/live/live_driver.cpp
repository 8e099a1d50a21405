#include "app/session/live/live_driver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "app/session/scene/frames.h"
#include "core/base/units.h"

namespace ostium::app {

namespace {

using units::mmHg;

constexpr std::uint64_t steps_a_trace = 10, steps_a_look = 100;

std::size_t signal_place(const SessionModel& model, const std::string& name) {
  const std::vector<std::string> names = signal_names(model);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Snapshot empty_snapshot(const SessionModel& model, Hands hands) {
  Snapshot s;
  s.state = make_state(model, 0);
  s.inputs.tools.resize(model.tools.size());
  s.tools.resize(model.tools.size());
  s.signals.assign(signal_count(model), 0);
  s.ecg_mV.assign(strip_samples, std::numeric_limits<float>::quiet_NaN());
  s.line_mmHg = s.ecg_mV;
  s.hands = hands;
  return s;
}

}  // namespace

LiveDriver::LiveDriver(const SessionModel& model, Hands hands, double frames_per_s, Driver* inner)
    : hands_(hands),
      began_as_(hands),
      frames_per_s_(frames_per_s),
      inner_(inner),
      console_(model),
      ecg_at_(signal_place(model, "ecg_II_mV")),
      line_at_(signal_place(model, "guide_mmHg")),
      row_(signal_count(model)),
      ecg_(strip_samples, std::numeric_limits<float>::quiet_NaN()),
      line_(ecg_),
      snapshots_{core::TripleBuffer<Snapshot>(empty_snapshot(model, hands)),
                 core::TripleBuffer<Snapshot>(empty_snapshot(model, hands))} {}

Driven LiveDriver::drive(const ScriptedRun& run, SessionInputs& inputs) {
  const SessionModel& model = run.model;
  const SessionState& state = run.state;
  const SessionReport& report = run.report;
  Driven driven = Driven::on;
  step_ = state.rods.step;
  console_.begin(inputs.c_arm);
  do {
    over_ |= asked_to_end_ && *asked_to_end_;
    for (Controls& seat : console_.controls)
      while (const std::optional<ConsoleOrder> order = seat.next()) act(model, *order);
    if (paused_ && !over_) {
      driven = Driven::after_a_stand;
      show(run, inputs);
      std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
  } while (paused_ && !over_);
  if (over_) return Driven::over;
  if (const Driven inner = inner_ ? inner_->drive(run, inputs) : Driven::on; inner != Driven::on) driven = inner;
  if (driven == Driven::over) return driven;
  if (checklist_ && step_ % steps_a_look == 0) checklist_->look(run);
  console_.fill(model, hands_, inputs);
  read_pressure(model, state);
  if (report.refused >= 0) refused_ = report.refused, in_its_way_ = report.in_its_way, refused_at_ = state.rods.step;
  if (state.rods.step > refused_at_ + 1000) refused_ = -1;
  if (state.rods.step % steps_a_trace == 0 && !report.tools.empty()) read_traces(run, inputs);
  if (is_frame(state.rods.step, std::max(frames_per_s_, console_.picture().frames_per_s), model.step_s()))
    show(run, inputs);
  return driven;
}

bool LiveDriver::marks() {
  const bool own = std::exchange(marks_, false), any = (inner_ && inner_->marks()) || own;
  if (any) ++marked_, marked_at_ = step_;
  return any;
}

void LiveDriver::remark(std::vector<OperatorEvent>& events) {
  if (checklist_) checklist_->take_done(events);
  if (const int asked = hinted_.exchange(-1); asked >= 0) events.push_back({OperatorEvent::Kind::hinted, asked, -1});
}

void LiveDriver::restart(const ScriptedRun& run) {
  for (Controls& seat : console_.controls)
    while (seat.next()) {  // what was asked for is over with the run that it was asked of
    }
  hands_ = began_as_;
  over_ = marks_ = false, paused_ = true, marked_ = 0, hinted_ = -1;
  ++begun_;
  const OperatorState& script = run.hands;
  CArmInputs asked;
  asked.lao_rad = script.lao_rad, asked.cran_rad = script.cran_rad, asked.field_m = script.field_m;
  asked.p_PI = script.p_PI;
  console_.restart(run.inputs, asked, run.moved_at);
  std::fill(ecg_.begin(), ecg_.end(), std::numeric_limits<float>::quiet_NaN());
  line_ = ecg_;
  refused_ = -1, refused_at_ = run.state.rods.step;
  line_count_ = 0, line_low_Pa_ = -1, guide_low_mmHg_ = guide_high_mmHg_ = NAN;
  show(run, run.inputs);
}

void LiveDriver::read_pressure(const SessionModel& model, const SessionState& state) {
  if (!model.has_patient()) return;
  const vascular::TipPressureState& line = state.blood.line;
  if (line.count < line_count_) {
    const bool has_trace = line_low_Pa_ > -1e5 && state.coupling.guide >= 0;
    guide_low_mmHg_ = has_trace ? line_low_Pa_ / mmHg : NAN, guide_high_mmHg_ = has_trace ? line_high_Pa_ / mmHg : NAN;
  }
  line_count_ = line.count, line_low_Pa_ = line.low_Pa, line_high_Pa_ = line.high_Pa;
}

void LiveDriver::read_traces(const ScriptedRun& run, const SessionInputs& inputs) {
  put_signals(run.model, run.state, inputs, run.report, row_.data());
  std::rotate(ecg_.begin(), ecg_.begin() + 1, ecg_.end());
  std::rotate(line_.begin(), line_.begin() + 1, line_.end());
  const float none = std::numeric_limits<float>::quiet_NaN();
  ecg_.back() = ecg_at_ < row_.size() ? row_[ecg_at_] : none;
  line_.back() = line_at_ < row_.size() ? row_[line_at_] : none;
}

void LiveDriver::act(const SessionModel& model, const ConsoleOrder& order) {
  switch (order.command) {
    case ConsoleCommand::pause:
      paused_ = !paused_;
      return;
    case ConsoleCommand::end:
      over_ = true;
      return;
    case ConsoleCommand::mark:
      marks_ = true;
      return;
    case ConsoleCommand::take_over:
      if (hands_ == Hands::script) hands_ = Hands::seats;
      return;
    case ConsoleCommand::hand_back:
      hands_ = began_as_;
      return;
    default:
      console_.take(model, order, hands_);
  }
}

void LiveDriver::show(const ScriptedRun& run, const SessionInputs& inputs) {
  const SessionReport& report = run.report;
  const bool began = !report.tools.empty();
  for (std::size_t seat = 0; seat < seats; ++seat) {
    if (!shown_to_[seat]) continue;
    Snapshot& s = snapshots_[seat].back();
    s.state = run.state;
    s.inputs = inputs;
    s.xrays = run.xrays;
    // While time stands, the arm is shown where it has been moved to.
    if (paused_) {
      const bool pedal = inputs.c_arm.fluoroscopy, film = inputs.c_arm.cine;
      s.inputs.c_arm = console_.arm();
      s.inputs.c_arm.fluoroscopy = pedal, s.inputs.c_arm.cine = film;
    }
    if (began) put_signals(run.model, run.state, inputs, report, s.signals.data());
    if (began) s.tools = report.tools;
    s.touches = report.rods.touches;
    s.ecg_mV = ecg_, s.line_mmHg = line_;
    s.guide_low_mmHg = guide_low_mmHg_, s.guide_high_mmHg = guide_high_mmHg_;
    s.picture = console_.picture();
    s.right_hand = console_.right_hand();
    s.script_step = began_as_ != Hands::script ? -1 : static_cast<int>(run.hands.step);
    s.refused = refused_, s.in_its_way = in_its_way_;
    s.marks = marked_, s.marked_s = static_cast<double>(marked_at_) * run.model.step_s();
    s.hands = hands_, s.paused = paused_, s.begun = begun_;
    s.overruns = run.overruns;
    snapshots_[seat].publish();
  }
}

}  // namespace ostium::app
