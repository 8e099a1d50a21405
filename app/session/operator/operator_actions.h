#pragma once
/// What the operator does in a step of a script, action by action.
#include "app/session/operator/condition_evaluator.h"

namespace ostium::app {

/// Once, as the step begins.
void begin_action(const data::ScriptStep& step, const SessionState& session, OperatorState& state);

/// In every millisecond of it: screws the inflation device, presses the syringe.
void continue_action(const data::ScriptStep& step, const SessionState& session, double now_s, OperatorState& state);

/// Whether it takes time: until its conditions hold, or until it is over by itself.
bool takes_time(const data::ScriptStep& step);

/// Whether it has come to an end by itself, where the script does not say until when.
bool is_over(const data::ScriptStep& step, const ConditionEvaluator& evaluator);

}  // namespace ostium::app
