#pragma once
/// What an operator sees of a session: whether the conditions of a script hold.
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/session/operator.h"
#include "app/session/outcome.h"

namespace ostium {

struct Sight {
  const ScriptPlan& plan;
  const SessionModel& model;
  const SessionState& session;
  const SessionReport& report;
  const OperatorState& state;

  double now_s() const { return seconds(model, session); }

  /// Several conditions of a step ask for the same tip.
  mutable int located_tool = -1, located_sphere = -1;
  int tip_sphere(int tool) const {
    if (tool != located_tool) {
      located_tool = tool;
      located_sphere =
          model.vessel->way->locate(tip(model, session, tool), session.blood.heart.phase, breath(model, session));
    }
    return located_sphere;
  }

  bool holds(const ScriptCondition& c, int place) const {
    const auto t = static_cast<std::size_t>(c.tool);
    const bool reported = !report.tools.empty();
    const ToolReport none, &tool = reported ? report.tools[t] : none;
    const double inserted = session.rods.rods[t].inserted_m;
    switch (c.kind) {
      case ConditionKind::tip_passes:
      case ConditionKind::tip_in:
        return tool.in_body && place >= 0 && model.vessel->way->beyond(tip_sphere(c.tool), place);
      case ConditionKind::tip_leaves:
        return !tool.in_body || place < 0 || !model.vessel->way->beyond(tip_sphere(c.tool), place);
      case ConditionKind::tip_on:
        return tool.in_body && place >= 0 && astray_m(c.tool, place) == 0;
      case ConditionKind::tip_astray:
        return tool.in_body && place >= 0 && astray_m(c.tool, place) >= c.value;
      case ConditionKind::tip_points:
        return tip_direction(model, session, c.tool).dot(c.direction_P) >= std::cos(c.value);
      case ConditionKind::tip_faces:
        return faces(c.tool, place, std::cos(c.value));
      case ConditionKind::tip_drops:
        return dropped_m(c.tool) >= c.value;
      case ConditionKind::fed:
        return std::fabs(session.hands[t].fed_m - state.began_fed_m[t]) >= c.value;
      case ConditionKind::inserted:
        return comes_in(t) ? inserted >= c.value : inserted <= c.value;
      case ConditionKind::out:
        return reported && !tool.in_body;
      case ConditionKind::turned:
        return std::fabs(session.hands[t].turned_rad - state.began_turned_rad[t]) >= c.value;
      case ConditionKind::hub_within:
        return std::fabs(session.hands[t].turned_rad) <= c.value;
      case ConditionKind::push_exceeds:
        return std::fabs(state.felt[4 * t]) > c.value;
      case ConditionKind::torque_exceeds:
        return std::fabs(state.felt[4 * t + 1]) > c.value;
      case ConditionKind::wall_force_exceeds:
        return state.felt[4 * t + 2] > c.value;
      case ConditionKind::tip_force_exceeds:
        return state.felt[4 * t + 3] > c.value;
      case ConditionKind::seconds:
        return now_s() - state.began_s >= c.value;
      case ConditionKind::beats:
        return session.blood.heart.beats + session.blood.heart.phase - state.began_beats >= c.value;
      case ConditionKind::balloon_at:
        return balloon_is_at(c.value, c.lesion);
      case ConditionKind::balloon_within:
        return balloon_is_within(c.value, c.lesion);
      case ConditionKind::balloon_clear:
        return balloon_is_out_of_guide(c.value);
      case ConditionKind::balloon_open:
        return balloon() && session.treatment.balloon.pressure_Pa > 101325 &&
               waist(*balloon(), session.treatment.balloon) > 0.9;
      case ConditionKind::balloon_empty:
        return !balloon() || is_empty(*balloon(), session.treatment.balloon);
      case ConditionKind::engaged:
        return guide_is_in(place);
      case ConditionKind::trace:
        return session.bedside.guide >= 0 && static_cast<int>(session.blood.line.trace) == place;
      case ConditionKind::contrast_in:
        return seen(place) > seen_kg_m3 && (session.c_arm.fluoroscopy || session.c_arm.cine);
      case ConditionKind::flow_below:
        return supply_behind_lesion(model, session, c.lesion) < c.value;
      case ConditionKind::ST_exceeds:
        return ST_shift_mV(model.physiology.ischaemia, session.blood.ischaemia) > 1e3 * c.value;
      case ConditionKind::act_exceeds:
        return act_s(model.treatment.drugs, session.treatment.drugs) > c.value;
      case ConditionKind::stenosis_below:
        return lesion_now(model, session, c.lesion).stenosis < c.value;
      case ConditionKind::stent_beyond:
        return lesion_is_covered(model, session, c.value, c.lesion);
      case ConditionKind::unharmed:
        return is_unharmed(model, session);
    }
    return false;
  }

  double astray_m(int tool, int place) const {
    return model.vessel->way->astray_m(tip_sphere(tool), model.vessel->way->branch(place));
  }

  /// Round the vessel, seen along it, does the tip point to where a branch leaves?
  bool faces(int tool, int branch, double cosine) const {
    const Way::Departure it = model.vessel->way->departure(branch, session.blood.heart.phase);
    const Eigen::Vector3d points = tip_direction(model, session, tool),
                          round = points - points.dot(it.along) * it.along;
    return round.dot(it.side) >= cosine * round.norm() && it.side.norm() > 0;
  }

  static constexpr double seen_kg_m3 = 60;

  const BalloonModel* balloon() const {
    const int b = session.bedside.balloon;
    return b < 0 ? nullptr : &model.treatment.balloons[static_cast<std::size_t>(b)];
  }

  /// A beat carries artery and shaft past each other by millimetres, so places are judged while the heart rests, before
  /// the R wave.
  std::optional<double> balloon_at_rest_m(int lesion) const {
    if (!heart_rests(session)) return {};
    return balloon_from_lesion_m(model, session, lesion);
  }

  bool balloon_is_within(double most_m, int lesion) const {
    const auto at = balloon_at_rest_m(lesion);
    return at && std::fabs(*at) <= most_m;
  }

  /// Whether this step feeds a tool; what the hand has done so far says it only of steps that are about other tools: a
  /// hand at a box begins some milliseconds late.
  bool comes_in(std::size_t tool) const {
    const ScriptStep& step = plan.script.steps[static_cast<std::size_t>(state.step)];
    const bool own = std::count(step.tools.begin(), step.tools.end(), static_cast<int>(tool)) > 0;
    if (own && step.action == ScriptAction::advance) return true;
    if (own && step.action == ScriptAction::withdraw) return false;
    return session.hands[tool].fed_m >= state.began_fed_m[tool];
  }

  /// Reached from the side that the shaft's hand comes from.
  bool balloon_is_at(double offset_m, int lesion) const {
    const auto at = balloon_at_rest_m(lesion);
    if (!at) return false;
    for (std::size_t t = 0; t < model.tools.size(); ++t)
      if (model.balloon_of[t] == session.bedside.balloon) return comes_in(t) ? *at >= offset_m : *at <= offset_m;
    return false;
  }

  bool balloon_is_out_of_guide(double by_m) const {
    const auto inserted_m = [&](std::size_t tool) { return session.rods.rods[tool].inserted_m; };
    const double guide_m = session.bedside.guide < 0 ? 0 : inserted_m(static_cast<std::size_t>(session.bedside.guide));
    for (std::size_t t = 0; t < model.tools.size(); ++t)
      if (session.bedside.balloon >= 0 && model.balloon_of[t] == session.bedside.balloon)
        return inserted_m(t) - marker_from_tip_m(model.tools[t].instrument, 0) >= guide_m + by_m;
    return false;
  }

  bool guide_is_in(int branch) const {
    const BedsideState& b = session.bedside;
    if (b.guide < 0) return false;
    const FlowTree& tree = model.physiology.flow.tree;
    const int first = tree.branches[static_cast<std::size_t>(branch)].first;
    if (b.tip.where == TipPlace::coronary) return b.tip.cell == first || tree.is_downstream(b.tip.cell, first);
    const auto side = static_cast<std::size_t>(b.tip.where == TipPlace::right_sinus);
    return b.tip.where >= TipPlace::left_sinus && model.physiology.contrast.coronary_branch[side] == branch &&
           b.tip.into_ostium > 0.6;
  }

  double seen(int cell) const {
    const double r = session.blood.radius_m[static_cast<std::size_t>(cell)];
    return concentration(session.blood.contrast, model.physiology.flow, cell, EIGEN_PI * r * r);
  }

  /// How far the tip went since the oldest note beyond what the hand moved.
  double dropped_m(int tool) const {
    const double* notes = &state.tips[static_cast<std::size_t>(4 * noted_tips * tool)];
    if (!(notes[3] == notes[3])) return 0;  // not a number: not noted for long enough
    const Eigen::Vector3d then(notes[0], notes[1], notes[2]);
    const double hand = std::fabs(session.hands[static_cast<std::size_t>(tool)].fed_m - notes[3]);
    return (tip(model, session, tool) - then).norm() - hand;
  }

  int first_that_holds(const std::vector<ScriptCondition>& conditions, const std::vector<int>& at) const {
    for (std::size_t i = 0; i < conditions.size(); ++i)
      if (holds(conditions[i], at[i])) return static_cast<int>(i);
    return -1;
  }
};

}  // namespace ostium
