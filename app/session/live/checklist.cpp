#include "app/session/live/checklist.h"

#include <algorithm>

#include "app/session/operator/condition_evaluator.h"

namespace ostium::app {

namespace {

/// A script that does nothing, and waits in each step for what an instruction waits for; `unless` holds what must be
/// meanwhile.
data::Script waiting(const std::vector<data::Instruction>& instructions, data::Script script) {
  script.steps.clear();
  for (const data::Instruction& one : instructions) {
    data::ScriptStep& step = script.steps.emplace_back();
    step.until = one.until, step.unless = one.meanwhile;
  }
  return script;
}

}  // namespace

std::optional<data::EventCode> event_called(const std::string& name) {
  for (const data::EventDefinition& one : data::event_definitions())
    if (one.name == name) return one.code;
  return {};
}

Checklist::Checklist(const std::vector<data::Instruction>& instructions, const data::Script& script,
                     const SessionModel& model)
    : plan_(make_plan(waiting(instructions, script), model, 0)) {
  int last = -1;
  for (const data::Instruction& one : instructions) {
    Item item;
    item.event = event_called(one.event), item.ticks = one.ticks();
    if (one.in_turn) item.after = last;
    if (item.ticks) last = static_cast<int>(items_.size());
    items_.push_back(item);
  }
}

/// What is counted, is counted from here.
void Checklist::begin(Item& item, const ScriptedRun& run) const {
  item.began = true;
  item.began_s = seconds(run.model, run.state);
  item.began_beats = run.state.blood.heart.beats + run.state.blood.heart.phase;
  item.began_fed_m.clear(), item.began_turned_rad.clear();
  for (const HandState& hand : run.state.hands)
    item.began_fed_m.push_back(hand.fed_m), item.began_turned_rad.push_back(hand.turned_rad);
}

void Checklist::look(const ScriptedRun& run) {
  if (std::ranges::all_of(items_, [](const Item& item) { return item.done || !item.ticks; })) return;
  looking_ = run.hands;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    Item& item = items_[i];
    const data::ScriptStep& step = plan_.script.steps[i];
    if (item.done || !item.ticks || !is_its_turn(item)) continue;
    if (!item.began) begin(item, run);
    looking_.step = static_cast<int>(i);
    looking_.began_s = item.began_s, looking_.began_beats = item.began_beats;
    looking_.began_fed_m = item.began_fed_m, looking_.began_turned_rad = item.began_turned_rad;
    const ConditionEvaluator evaluator(plan_, run.model, run.state, run.report, looking_);
    const std::vector<int>& places = plan_.unless_places[i];
    bool meanwhile = true;
    for (std::size_t k = 0; k < places.size(); ++k) meanwhile &= evaluator.holds(step.unless[k], places[k]);
    if (!meanwhile) item.began = false;
    item.done = meanwhile && evaluator.first_that_holds(step.until, plan_.until_places[i]) >= 0;
  }
}

void Checklist::hear(const SessionEvent& event) {
  for (Item& item : items_)
    if (item.event && static_cast<int>(*item.event) == event.code && is_its_turn(item)) item.done = true;
}

void Checklist::take_done(std::vector<OperatorEvent>& events) {
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (!items_[i].done || items_[i].told) continue;
    items_[i].told = true;
    events.push_back({OperatorEvent::Kind::instructed, static_cast<int>(i), -1});
  }
}

void Checklist::go_back(const std::vector<SessionEvent>& before) {
  for (Item& item : items_) item.done = item.told = item.began = false;
  for (const SessionEvent& event : before)
    if (const auto at = static_cast<std::size_t>(std::max(0.0, event.value));
        event.code == static_cast<int>(data::EventCode::instruction_done) && at < items_.size())
      items_[at].done = items_[at].told = true;
}

}  // namespace ostium::app
