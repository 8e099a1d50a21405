#include "app/session/device/box_driver.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ostium::app {

namespace {

device::Tool tool_for(data::InstrumentKind kind) {
  switch (kind) {
    case data::InstrumentKind::wire:
      return device::Tool::wire;
    case data::InstrumentKind::balloon_shaft:
    case data::InstrumentKind::stent_shaft:
      return device::Tool::shaft;
    case data::InstrumentKind::guide_catheter:
    case data::InstrumentKind::diagnostic_catheter:
    case data::InstrumentKind::sheath:
      return device::Tool::guide;
  }
  return device::Tool::none;
}

}  // namespace

std::vector<device::Tool> tools_at_the_box(const SessionModel& model) {
  std::vector<device::Tool> held;
  for (const SessionTool& tool : model.tools) held.push_back(tool_for(tool.instrument.kind));
  return held;
}

std::vector<ToolTurn> turns_at_the_box(const std::vector<device::Tool>& held) {
  std::vector<ToolTurn> turns;
  for (std::size_t t = 0; t < held.size(); ++t)
    turns.push_back(
        {static_cast<std::uint32_t>(std::count(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(t), held[t])),
         static_cast<std::uint32_t>(std::count(held.begin(), held.end(), held[t]))});
  return turns;
}

data::Script free_hands(data::Script script) {
  std::erase_if(script.steps, [moved = false](const data::ScriptStep& step) mutable {
    using enum data::ScriptAction;
    moved |= !step.until.empty();
    return moved ||
           (step.action != view && step.action != fluoroscopy && step.action != cine && step.action != heart_rate);
  });
  data::ScriptStep wait;
  wait.label = "moved by hand";
  wait.timeout_s = 1e9;
  wait.until.emplace_back().value = 1e9;  // seconds
  script.steps.push_back(wait);
  script.by_hand = true;
  return script;
}

BoxDriver::BoxDriver(BoxDriverSettings settings, Exchange exchange, const std::atomic<bool>* stop)
    : settings_(std::move(settings)), exchange_(std::move(exchange)), stop_(stop) {
  request_.arm = settings_.arm;
}

void BoxDriver::begin(const SessionModel& model) {
  held_ = tools_at_the_box(model);
  turns_ = turns_at_the_box(held_);
  pending_turn_rad_.assign(held_.size(), 0);
  now_ = exchange_(request_);
  for (std::size_t i = 0; i < ostium::device::tools; ++i) turned_rad_[i] = now_.tool[i].turned_rad;
}

device::Tool BoxDriver::source(std::size_t t) const {
  const ToolTurn turn = turns_[t];
  const bool is_last_wire = held_[t] == device::Tool::wire && turn.count > 1 && turn.place + 1 == turn.count;
  if (is_last_wire && now_.tool[index_of(device::Tool::second_wire)].sight != device::ToolPresence::absent)
    return device::Tool::second_wire;
  const std::uint32_t arrivals = now_.tool[index_of(held_[t])].arrivals;
  return arrivals > 0 && (arrivals - 1) % turn.count == turn.place ? held_[t] : device::Tool::none;
}

/// Forces of a step that had to give way are no real instrument's.
void BoxDriver::feel(const SessionReport& report) {
  if (report.rods.trouble & (core::not_converged | core::motion_lost | core::no_solution | core::pulled_apart)) return;
  for (std::size_t t = 0; t < report.tools.size(); ++t)
    if (held_[t] != device::Tool::none)
      request_.load[index_of(held_[t])] = {report.tools[t].push_N, report.tools[t].torque_Nm};
}

void BoxDriver::press_buttons(SessionInputs& inputs) {
  const std::uint16_t pressed = now_.pedals & static_cast<std::uint16_t>(~buttons_);
  buttons_ = now_.pedals;
  for (int k = 0; k < static_cast<int>(settings_.views.size()) && k < 14; ++k)
    if (pressed >> (k + 2) & 1) view_ = k;
  inputs.c_arm.fluoroscopy = now_.pedals & 1, inputs.c_arm.cine = now_.pedals >> 1 & 1;
  if (view_ >= 0)
    std::tie(inputs.c_arm.lao_rad, inputs.c_arm.cran_rad) = settings_.views[static_cast<std::size_t>(view_)];
}

/// What is in the syringe is not the box's to know.
void BoxDriver::inflate_and_inject(SessionInputs& inputs) const {
  const double gauge_Pa = pressure_Pa(), injected_m3_s = flow_m3_s();
  inputs.delivery.gauge_Pa = std::abs(gauge_Pa) < settings_.least_pressure_Pa ? 0 : gauge_Pa;
  inputs.delivery.injection_m3_s = injected_m3_s < settings_.least_flow_m3_s ? 0 : injected_m3_s;
  inputs.delivery.aspiration_m3_s = -injected_m3_s < settings_.least_flow_m3_s ? 0 : -injected_m3_s;
}

Driven BoxDriver::drive(const ScriptedRun& run, SessionInputs& inputs) {
  const SessionModel& model = run.model;
  if (held_.size() != model.tools.size()) begin(model);
  feel(run.report);
  request_.step_s = seconds(model, run.state);
  bool standing = false, stood = false;
  do {
    if (stop_ && stop_->load(std::memory_order_relaxed)) return Driven::over;
    now_ = exchange_(request_);
    shown_.put(now_);
    if (settings_.watch) settings_.watch(now_);
    stood_ += now_.pause != device::Pause::none && !standing;
    standing = now_.pause != device::Pause::none;
    stood |= standing;
  } while (standing);
  press_buttons(inputs);
  if (model.has_patient()) inflate_and_inject(inputs);
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const device::Tool tool = source(t);
    const double inserted_m = tool == device::Tool::none ? 0 : now_.tool[index_of(tool)].inserted_m;
    const double depth_m = std::clamp(inserted_m, 0.0, model.tools[t].instrument.length_m);
    device::PendingDrive pending{depth_m - run.state.rods.rods[t].inserted_m, pending_turn_rad_[t]};
    if (tool != device::Tool::none)
      pending.turn_rad += now_.tool[index_of(tool)].turned_rad - turned_rad_[index_of(tool)];
    const device::DriveRates rates = take(model.step_s(), settings_.smooth_s, pending);
    inputs.tools[t] = {std::clamp(rates.feed_m_s, -settings_.fastest_m_s, settings_.fastest_m_s), rates.turn_rad_s};
    pending_turn_rad_[t] = pending.turn_rad;
  }
  for (std::size_t i = 0; i < ostium::device::tools; ++i) turned_rad_[i] = now_.tool[i].turned_rad;
  return stood ? Driven::after_a_stand : Driven::on;
}

}  // namespace ostium::app
