#pragma once
/// Evaluates the conditions of a script from what an operator can see of a session.
#include <vector>

#include "app/session/operator/operator.h"

namespace ostium::app {

class ConditionEvaluator {
 public:
  ConditionEvaluator(const ScriptPlan& plan, const SessionModel& model, const SessionState& session,
                     const SessionReport& report, const OperatorState& state)
      : plan(plan), model(model), session(session), report(report), state(state) {}

  const ScriptPlan& plan;
  const SessionModel& model;
  const SessionState& session;
  const SessionReport& report;
  const OperatorState& state;

  /// `place`: the condition's place as resolved in the plan.
  bool holds(const data::ScriptCondition& condition, int place) const;
  /// The number that the condition is about, in SI; NaN if it is about none, or there is none to see.
  double measured(const data::ScriptCondition& condition) const;
  /// Index of the first that holds, or -1; `at`: their places.
  int first_that_holds(const std::vector<data::ScriptCondition>& conditions, const std::vector<int>& at) const;

  // Quantities that conditions use:
  double now_s() const;
  ToolReport tool(int tool) const;  ///< as reported; all zero before the session begins
  double fed_m(int tool) const;     ///< since the step began
  double turned_rad(int tool) const;
  bool tip_is_beyond(int tool, int place) const;
  double astray_m(int tool, int place) const;
  bool faces(int tool, int branch, double cosine) const;
  double dropped_m(int tool) const;
  bool comes_in(int tool) const;
  /// That of the step's tool, or the one that came into the body first. Null: there is none.
  BalloonInBody balloon() const;
  const vascular::BalloonModel& model_of(const BalloonInBody& balloon) const;
  bool balloons_are_empty() const;               ///< that of the step's tool, or all in the body
  double balloon_from_lesion(int lesion) const;  ///< m; NaN: not in its artery
  int balloon_tool() const;                      ///< the step's tool, if it carries one; -1
  /// Of its distal marker from where a branch leaves its parent, m; NaN: it does not lie along that.
  double distal_marker_beyond_m(const std::string& branch) const;
  bool balloon_is_at(const data::ScriptCondition& condition) const;
  double balloon_beyond_guide_m() const;
  bool guide_is_in(int branch) const;
  double contrast_kg_m3(int cell) const;
  bool contrast_is_seen(int cell) const;
  bool beam_is_on() const { return session.c_arm.fluoroscopy || session.c_arm.cine; }

 private:
  int tip_sphere(int tool) const;
  /// Cached, since several conditions of a step use the same tip.
  mutable int located_tool_ = -1, located_sphere_ = -1;
};

}  // namespace ostium::app
