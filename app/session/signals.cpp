#include "app/session/signals.h"

#include <cmath>

#include "core/rod/introducer.h"
#include "data/metrics.h"

namespace ostium {

namespace {

constexpr const char* of_a_tool[] = {"inserted_mm", "turned_deg",   "tip_x_mm",     "tip_y_mm",
                                     "tip_z_mm",    "tip_branch",   "tip_along_mm", "push_N",
                                     "torque_mNm",  "wall_force_N", "tip_force_N",  "touches"};

}  // namespace

std::size_t signal_count(const SessionModel& model) { return 2 + model.tools.size() * std::size(of_a_tool); }

std::vector<std::string> signal_names(const SessionModel& model) {
  std::vector<std::string> names = {"time_s", "heart_phase"};
  for (const SessionTool& tool : model.tools)
    for (const char* name : of_a_tool) names.push_back(tool.name + "." + name);
  return names;
}

void put_signals(const SessionModel& model, const SessionState& state, const SessionReport& report, float* row) {
  const auto put = [&](double number) { *row++ = static_cast<float>(number); };
  put(seconds(model, state));
  put(state.heart.phase);
  for (int t = 0; t < static_cast<int>(model.tools.size()); ++t) {
    const auto i = static_cast<std::size_t>(t);
    const ToolReport& tool = report.tools[i];
    const Eigen::Vector3d p = tip(model, state, t);
    const Way& way = *model.vessel->way;
    const int sphere = tool.in_body ? way.locate(p, state.heart.phase) : -1;
    put(1e3 * state.rods.rods[i].inserted_m);
    put(180 / EIGEN_PI * state.hands[i].turned_rad);
    for (int axis = 0; axis < 3; ++axis) put(1e3 * p[axis]);
    put(sphere < 0 ? -1 : way.branch(sphere));
    put(sphere < 0 ? 0 : 1e3 * way.from_access_m(sphere));
    put(tool.push_N);
    put(1e3 * tool.torque_Nm);
    put(tool.wall_force_N);
    put(tool.tip_force_N);
    put(tool.touches);
  }
}

EventWatch::EventWatch(const SessionModel& model) : tools_(model.tools.size()) {}

void EventWatch::look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                      const SessionReport& report, const std::vector<OperatorEvent>& script,
                      std::vector<SessionEvent>& events) {
  const std::uint64_t now = state.rods.step;
  const auto say = [&](EventCode code, int tool, double value) {
    events.push_back({now, static_cast<int>(code), tool, value});
  };
  for (const OperatorEvent& e : script) {
    using Kind = OperatorEvent::Kind;
    say(e.kind == Kind::begins   ? EventCode::script_step_begins
        : e.kind == Kind::done   ? EventCode::script_step_done
        : e.kind == Kind::failed ? EventCode::script_step_failed
        : e.kind == Kind::marked ? EventCode::mark
                                 : EventCode::script_step_timed_out,
        -1, e.step);
  }
  for (int t = 0; t < static_cast<int>(tools_.size()); ++t) {
    Tool& before = tools_[static_cast<std::size_t>(t)];
    const ToolReport& tool = report.tools[static_cast<std::size_t>(t)];
    if (tool.in_body != before.in_body) say(tool.in_body ? EventCode::tool_in : EventCode::tool_out, t, 0);
    before.in_body = tool.in_body;
    before.wall_force_N += (1 - std::exp(-2 * EIGEN_PI * wall_force_cut_off_Hz * model.step_s())) *
                           (tool.wall_force_N - before.wall_force_N);
    const bool pressed = before.wall_force_N > (before.pressed ? 0.8 : 1) * wall_force_limit_N;
    if (pressed && !before.pressed) say(EventCode::wall_force_high, t, before.wall_force_N);
    before.pressed = pressed;
    if (now % 10 != 0) continue;
    const Way& way = *model.vessel->way;
    const int branch = tool.in_body ? way.branch(way.locate(tip(model, state, t), state.heart.phase)) : -1;
    if (branch >= 0 && branch != before.branch) say(EventCode::tip_enters, t, branch);
    before.branch = branch;
  }
  const CArmInputs& arm = inputs.c_arm;
  if (arm.fluoroscopy != fluoroscopy_)
    say(arm.fluoroscopy > 0 ? EventCode::fluoroscopy_on : EventCode::fluoroscopy_off, -1, 0);
  if (arm.cine != cine_) say(arm.cine > 0 ? EventCode::cine_on : EventCode::cine_off, -1, 0);
  fluoroscopy_ = arm.fluoroscopy, cine_ = arm.cine;
  const std::uint32_t trouble = report.rods.trouble & ~static_cast<std::uint32_t>(feed_stopped | drive_limited);
  if (trouble && !trouble_) say(EventCode::step_trouble, -1, trouble);
  trouble_ = trouble;
}

}  // namespace ostium
