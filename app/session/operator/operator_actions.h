#pragma once
/// What the operator does in a step of a script, for each action.
#include "app/session/operator/condition_evaluator.h"

namespace ostium::app {

/// Called once, when the step begins.
/// `subject`: of ScriptPlan.
void begin_action(const data::ScriptStep& step, int subject, const SessionState& session, OperatorState& state);

/// Index of the step's drug. Throws LoadError with the script's line for a drug, a unit or a dose that there is not.
int find_drug(const data::ScriptStep& step, const vascular::DrugModel& drugs, const data::Script& script);

/// Called every millisecond of the step: pressurises the inflation device, presses the syringe.
void continue_action(const data::ScriptStep& step, const SessionState& session, double now_s, OperatorState& state);

/// Whether the step takes time: until its conditions hold or its action ends by itself.
bool takes_time(const data::ScriptStep& step);

/// Whether the action has ended by itself, for steps without `until`.
bool is_over(const data::ScriptStep& step, const ConditionEvaluator& evaluator);

/// What that would be, for such steps, and how far it has come: "volume_mL 5 (now 1.2)".
std::string end_of_action(const data::ScriptStep& step, const ConditionEvaluator& evaluator);

/// Whether the action goes through a catheter in the body.
constexpr bool needs_catheter(data::ScriptAction action) {
  return action == data::ScriptAction::inject || action == data::ScriptAction::aspirate;
}

}  // namespace ostium::app
