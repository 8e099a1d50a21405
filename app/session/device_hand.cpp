#include "app/session/device_hand.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ostium {

namespace {

Tool tool_for(InstrumentKind kind, int wires_before) {
  switch (kind) {
    case InstrumentKind::wire:
      return wires_before == 0 ? Tool::wire : Tool::second_wire;
    case InstrumentKind::balloon_shaft:
    case InstrumentKind::stent_shaft:
      return Tool::shaft;
    case InstrumentKind::guide_catheter:
    case InstrumentKind::diagnostic_catheter:
    case InstrumentKind::sheath:
      return Tool::guide;
  }
  return Tool::none;
}

}  // namespace

std::vector<Tool> tools_at_the_box(const SessionModel& model) {
  std::vector<Tool> held;
  int wires = 0;
  for (const SessionTool& tool : model.tools) {
    const Tool at = tool_for(tool.instrument.kind, wires);
    wires += tool.instrument.kind == InstrumentKind::wire;
    held.push_back(std::find(held.begin(), held.end(), at) == held.end() ? at : Tool::none);
  }
  return held;
}

Script free_hands(Script script) {
  std::erase_if(script.steps, [moved = false](const ScriptStep& step) mutable {
    moved |= !step.until.empty();
    return moved;
  });
  ScriptStep wait;
  wait.label = "hands at the box";
  wait.timeout_s = 1e9;
  wait.until.emplace_back().value = 1e9;  // seconds
  script.steps.push_back(wait);
  return script;
}

DeviceHand::DeviceHand(DeviceHandSettings settings, Exchange exchange, const std::atomic<bool>* stop)
    : settings_(std::move(settings)), exchange_(std::move(exchange)), stop_(stop) {
  request_.arm = settings_.arm;
}

void DeviceHand::begin(const SessionModel& model) {
  held_ = tools_at_the_box(model);
  pending_turn_rad_.assign(held_.size(), 0);
  turned_rad_.assign(held_.size(), 0);
  now_ = exchange_(request_);
  for (std::size_t t = 0; t < held_.size(); ++t)
    if (held_[t] != Tool::none) turned_rad_[t] = now_.tool[index_of(held_[t])].turned_rad;
}

/// Forces of a step that had to give way are no real instrument's.
void DeviceHand::feel(const SessionReport& report) {
  if (report.rods.trouble & (not_converged | motion_lost | no_solution | pulled_apart)) return;
  for (std::size_t t = 0; t < report.tools.size(); ++t)
    if (held_[t] != Tool::none) request_.load[index_of(held_[t])] = {report.tools[t].push_N, report.tools[t].torque_Nm};
}

void DeviceHand::press_buttons(SessionInputs& inputs) {
  const std::uint16_t pressed = now_.pedals & static_cast<std::uint16_t>(~buttons_);
  buttons_ = now_.pedals;
  for (int k = 0; k < static_cast<int>(settings_.views.size()) && k < 14; ++k)
    if (pressed >> (k + 2) & 1) view_ = k;
  inputs.c_arm.fluoroscopy = now_.pedals & 1, inputs.c_arm.cine = now_.pedals >> 1 & 1;
  if (view_ >= 0)
    std::tie(inputs.c_arm.lao_rad, inputs.c_arm.cran_rad) = settings_.views[static_cast<std::size_t>(view_)];
}

bool DeviceHand::drive(const SessionModel& model, const SessionState& state, const SessionReport& report,
                       SessionInputs& inputs) {
  if (held_.size() != model.tools.size()) begin(model);
  feel(report);
  request_.step_s = seconds(model, state);
  bool standing = false;
  do {
    if (stop_ && stop_->load(std::memory_order_relaxed)) return false;
    now_ = exchange_(request_);
    if (settings_.watch) settings_.watch(now_);
    stood_ += now_.pause != Pause::none && !standing;
    standing = now_.pause != Pause::none;
  } while (standing);
  press_buttons(inputs);
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    inputs.tools[t] = {};
    if (held_[t] == Tool::none) continue;
    const ToolSnapshot& hand = now_.tool[index_of(held_[t])];
    const double depth_m = std::clamp(hand.inserted_m, 0.0, model.tools[t].instrument.length_m);
    PendingDrive pending{depth_m - state.rods.rods[t].inserted_m,
                         pending_turn_rad_[t] + hand.turned_rad - turned_rad_[t]};
    const DriveRates rates = take(model.step_s(), settings_.smooth_s, pending);
    inputs.tools[t] = {std::clamp(rates.advance_m_s, -settings_.fastest_m_s, settings_.fastest_m_s), rates.turn_rad_s};
    pending_turn_rad_[t] = pending.turn_rad;
    turned_rad_[t] = hand.turned_rad;
  }
  return true;
}

}  // namespace ostium
