#include "app/session/run/run.h"

#include <utility>

namespace ostium::app {

namespace {

ScriptPlan plan_of(const RunSetup& setup, const SessionModel& model) {
  ScriptPlan plan = make_plan(setup.script, model, setup.seed);
  plan.hand_speed = setup.hand_speed;
  return plan;
}

}  // namespace

void note_moved(const SessionInputs& inputs, std::uint64_t step, std::vector<std::uint64_t>& moved_at) {
  for (std::size_t t = 0; t < inputs.tools.size(); ++t)
    if (inputs.tools[t].feed_m_s != 0 || inputs.tools[t].turn_rad_s != 0) moved_at[t] = step;
}

ScriptedRun::ScriptedRun(const RunSetup& setup, std::shared_ptr<const Vessel> vessel, Driver* driver)
    : model(make_session(setup, std::move(vessel))),
      plan(plan_of(setup, model)),
      state(make_state(model, setup.seed)),
      hands(make_state(plan, model)),
      scratch_(model),
      driver_(driver) {
  if (setup.rate_1_min) hands.rate_1_min = *setup.rate_1_min;
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (model.tools[t].name == setup.stuck) stuck_ = static_cast<int>(t);
  inputs.tools.resize(model.tools.size()), moved_at.resize(model.tools.size());
  events.reserve(64);
}

bool ScriptedRun::tick() {
  const bool holds = driver_ && driver_->holds_script();
  if (held_ && !holds) hands.began = true;
  held_ = holds;
  if (holds)
    events.clear();
  else
    outcome = decide(plan, model, state, report, hands, inputs, events);
  if (outcome != Outcome::running) return false;
  const Driven driven = driver_ ? driver_->drive(*this, inputs) : Driven::on;
  if (driver_ && driver_->marks()) events.push_back({OperatorEvent::Kind::marked, hands.step, -1});
  if (driver_) driver_->remark(events);
  stood = driven == Driven::after_a_stand;
  if (driven == Driven::over) {
    outcome = hands.outcome = plan.script.by_hand ? Outcome::ended : Outcome::aborted;
    return false;
  }
  if (stuck_ >= 0) inputs.tools[stuck_] = {};
  advance();
  return true;
}

void ScriptedRun::repeat(const SessionInputs& recorded) {
  inputs = recorded;
  events.clear();
  advance();
}

void ScriptedRun::advance() {
  step(model, inputs, state, scratch_, report);
  xrays.add(inputs.c_arm, state.rods.step, model.step_s());
  note_moved(inputs, state.rods.step, moved_at);
  const std::uint32_t trouble = report.rods.trouble & ~static_cast<std::uint32_t>(core::feed_stopped);
  if (trouble) ++troubled, troubles |= trouble;
}

std::string trouble_words(std::uint32_t trouble) {
  static constexpr std::pair<core::Trouble, const char*> words[] = {
      {core::drive_limited, "drive_limited"},      {core::drive_not_finite, "drive_not_finite"},
      {core::load_limited, "load_limited"},        {core::not_converged, "not_converged"},
      {core::motion_lost, "motion_lost"},          {core::no_solution, "no_solution"},
      {core::feed_stopped, "feed_stopped"},        {core::pulled_apart, "pulled_apart"},
      {core::joint_overturned, "joint_overturned"}};
  std::string out;
  for (const auto& [bit, word] : words) {
    if (trouble & bit) out += (out.empty() ? "" : ", ") + std::string(word);
    trouble &= ~static_cast<std::uint32_t>(bit);
  }
  return trouble ? out + (out.empty() ? "others" : ", others") : out;
}

}  // namespace ostium::app
