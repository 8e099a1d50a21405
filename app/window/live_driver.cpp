#include "app/window/live_driver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "app/session/scene/film.h"
#include "core/base/units.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

namespace {

using units::atm, units::mmHg;

constexpr double degree = units::pi / 180;
constexpr std::uint64_t steps_a_sample = 10;

std::size_t place_of(const SessionModel& model, const std::string& name) {
  const std::vector<std::string> names = signal_names(model);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

int guide_of(const SessionModel& model) {
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (model.tools[t].instrument.kind == data::InstrumentKind::guide_catheter) return static_cast<int>(t);
  return 0;
}

Snapshot empty_snapshot(const SessionModel& model) {
  Snapshot s;
  s.state = make_state(model, 0);
  s.inputs.tools.resize(model.tools.size());
  s.in_body.assign(model.tools.size(), 0);
  s.signals.assign(signal_count(model), 0);
  s.ecg_mV.assign(strip_samples, std::numeric_limits<float>::quiet_NaN());
  s.line_mmHg = s.ecg_mV;
  return s;
}

}  // namespace

LiveDriver::LiveDriver(const SessionModel& model, bool plays, double frames_per_s, Driver* inner)
    : plays_(plays),
      frames_per_s_(frames_per_s),
      inner_(inner),
      left_(guide_of(model)),
      ecg_at_(place_of(model, "ecg_II_mV")),
      line_at_(place_of(model, "guide_mmHg")),
      row_(signal_count(model)),
      ecg_(strip_samples, std::numeric_limits<float>::quiet_NaN()),
      line_(ecg_),
      snapshots_(empty_snapshot(model)) {
  const int count = static_cast<int>(model.tools.size());
  if (count > 1) right_ = left_ == 0 ? 1 : 0;
}

Driven LiveDriver::drive(const ScriptedRun& run, SessionInputs& inputs) {
  const SessionModel& model = run.model;
  const SessionState& state = run.state;
  const SessionReport& report = run.report;
  if (!arm_is_set_) arm_ = inputs.c_arm, arm_is_set_ = true;
  heparin_U_ = nitrate_ug_ = 0;
  Driven driven = Driven::on;
  do {
    while (const std::optional<Action> action = controls.next()) act(model, *action);
    if (paused_ && !over_) {
      driven = Driven::after_a_stand;
      show(run, inputs);
      std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
  } while (paused_ && !over_);
  if (over_) return Driven::over;
  if (const Driven inner = inner_ ? inner_->drive(run, inputs) : Driven::on; inner != Driven::on) driven = inner;
  if (driven == Driven::over) return driven;
  if (plays_) play(model, inputs);
  read_pressure(model, state);
  if (report.refused >= 0) refused_ = report.refused, in_its_way_ = report.in_its_way, refused_at_ = state.rods.step;
  if (state.rods.step > refused_at_ + 1000) refused_ = -1;

  if (state.rods.step % steps_a_sample == 0 && !report.tools.empty()) {
    put_signals(model, state, inputs, report, row_.data());
    std::rotate(ecg_.begin(), ecg_.begin() + 1, ecg_.end());
    std::rotate(line_.begin(), line_.begin() + 1, line_.end());
    const float none = std::numeric_limits<float>::quiet_NaN();
    ecg_.back() = ecg_at_ < row_.size() ? row_[ecg_at_] : none;
    line_.back() = line_at_ < row_.size() ? row_[line_at_] : none;
  }
  if (is_frame(state.rods.step, frames_per_s_, model.step_s())) show(run, inputs);
  return driven;
}

bool LiveDriver::marks() {
  const bool own = std::exchange(marks_, false);
  return (inner_ && inner_->marks()) || own;
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

void LiveDriver::act(const SessionModel& model, Action action) {
  switch (action) {
    case Action::pause:
      paused_ = !paused_;
      return;
    case Action::quit:
      over_ = true;
      return;
    case Action::heparin:
      heparin_U_ += 5000;
      return;
    case Action::nitrate:
      nitrate_ug_ += 200;
      return;
    case Action::swap: {
      const int count = static_cast<int>(model.tools.size());
      for (int k = 1; k <= count && right_ >= 0; ++k)
        if (const int next = (right_ + k) % count; next != left_) {
          right_ = next;
          break;
        }
      return;
    }
    case Action::atm_up:
      gauge_Pa_ = std::max(gauge_Pa_, 0.0) + atm;
      return;
    case Action::atm_down:
      gauge_Pa_ = std::max(gauge_Pa_ - atm, 0.0);
      return;
    case Action::release:
      gauge_Pa_ = 0;
      return;
    case Action::left:
      arm_.lao_rad += 5 * degree;
      break;
    case Action::right:
      arm_.lao_rad -= 5 * degree;
      break;
    case Action::cranial:
      arm_.cran_rad += 5 * degree;
      break;
    case Action::caudal:
      arm_.cran_rad -= 5 * degree;
      break;
    case Action::table_left:
      arm_.p_PI.x() += 0.01;
      break;
    case Action::table_right:
      arm_.p_PI.x() -= 0.01;
      break;
    case Action::table_up:
      arm_.p_PI.y() += 0.01;
      break;
    case Action::table_down:
      arm_.p_PI.y() -= 0.01;
      break;
    case Action::zoom: {
      std::size_t now = 0;
      for (std::size_t i = 0; i < std::size(fluoro::fields_m); ++i)
        if (std::fabs(arm_.field_m - fluoro::fields_m[i]) < 1e-6) now = i;
      arm_.field_m = fluoro::fields_m[(now + 1) % std::size(fluoro::fields_m)];
      break;
    }
    case Action::mark:
      marks_ = true;
      return;
    case Action::reference:
    case Action::help:
      return;  // of the window
    default: {
      const auto n = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::view_1);
      const auto& views = fluoro::standard_views();
      if (n < views.size()) arm_.lao_rad = views[n].lao_deg * degree, arm_.cran_rad = views[n].cran_deg * degree;
    }
  }
  const fluoro::CArmLimits limits;
  arm_.lao_rad = std::clamp(arm_.lao_rad, -limits.lao_rad, limits.lao_rad);
  arm_.cran_rad = std::clamp(arm_.cran_rad, -limits.cran_rad, limits.cran_rad);
}

void LiveDriver::play(const SessionModel& model, SessionInputs& inputs) {
  const double share = controls.get(Level::fine) > 0.5 ? fine_share : 1;
  for (ToolInputs& tool : inputs.tools) tool = {};
  const auto move = [&](int tool, Level feed, Level turn) {
    if (tool < 0) return;
    inputs.tools[static_cast<std::size_t>(tool)] = {share * hand_feed_m_s * controls.get(feed),
                                                    share * hand_turn_rad_s * controls.get(turn)};
  };
  move(left_, Level::guide_feed, Level::guide_turn);
  move(right_, Level::device_feed, Level::device_turn);
  inputs.c_arm = arm_;
  inputs.c_arm.fluoroscopy = controls.get(Level::fluoroscopy) > 0.3;
  inputs.c_arm.cine = controls.get(Level::cine) > 0.3;
  if (!model.has_patient()) return;
  DeliveryInputs& hand = inputs.delivery;
  const double contrast = controls.get(Level::contrast), flush = controls.get(Level::flush);
  hand.injection_m3_s = contrast > 0.02 ? contrast * hand_contrast_m3_s : flush > 0.02 ? flush * hand_flush_m3_s : 0;
  hand.iodine_kg_m3 = contrast > 0.02 || flush <= 0.02 ? 350 : 0;
  hand.gauge_Pa = controls.get(Level::vacuum) > 0.5 ? -0.9 * atm : gauge_Pa_;
  hand.heparin_U = heparin_U_, hand.nitrate_ug = nitrate_ug_;
}

void LiveDriver::show(const ScriptedRun& run, const SessionInputs& inputs) {
  const SessionReport& report = run.report;
  if (report.tools.empty()) return;
  Snapshot& s = snapshots_.back();
  s.state = run.state;
  s.inputs = inputs;
  s.xrays = run.xrays;
  if (plays_) s.inputs.c_arm.lao_rad = arm_.lao_rad, s.inputs.c_arm.cran_rad = arm_.cran_rad;
  put_signals(run.model, run.state, inputs, report, s.signals.data());
  for (std::size_t t = 0; t < report.tools.size(); ++t) s.in_body[t] = report.tools[t].in_body;
  s.ecg_mV = ecg_, s.line_mmHg = line_;
  s.guide_low_mmHg = guide_low_mmHg_, s.guide_high_mmHg = guide_high_mmHg_;
  s.right_hand = right_;
  s.script_step = plays_ ? -1 : static_cast<int>(run.hands.step);
  s.refused = refused_, s.in_its_way = in_its_way_;
  s.paused = paused_;
  s.overruns = run.overruns;
  snapshots_.publish();
}

}  // namespace ostium::app
