#include "app/session/operator/condition_evaluator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/session/coupling/tool_geometry.h"
#include "app/session/model/outcome.h"
#include "core/base/units.h"

namespace ostium::app {

namespace {

using Evaluator = ConditionEvaluator;
using Condition = data::ScriptCondition;
/// Tests a condition at its place.
using Test = bool (*)(const Evaluator&, const Condition&, int place);
struct TestOfKind {
  data::ConditionKind kind;
  Test holds;
};

std::size_t index(int tool) { return static_cast<std::size_t>(tool); }

bool is_beyond(const Evaluator& e, const Condition& c, int place) { return e.tip_is_beyond(c.tool, place); }

/// One per kind, in any order.
constexpr TestOfKind tests[] = {
    {data::ConditionKind::tip_passes, is_beyond},
    {data::ConditionKind::tip_in, is_beyond},
    {data::ConditionKind::tip_leaves,
     [](const Evaluator& e, const Condition& c, int place) { return !e.tip_is_beyond(c.tool, place); }},
    {data::ConditionKind::tip_on,
     [](const Evaluator& e, const Condition& c, int place) {
       return e.tool(c.tool).in_body && place >= 0 && e.astray_m(c.tool, place) == 0;
     }},
    {data::ConditionKind::tip_astray,
     [](const Evaluator& e, const Condition& c, int place) {
       return e.tool(c.tool).in_body && place >= 0 && e.astray_m(c.tool, place) >= c.value;
     }},
    {data::ConditionKind::tip_points,
     [](const Evaluator& e, const Condition& c, int) {
       return tip_direction(e.model, e.session, c.tool).dot(c.direction_P) >= std::cos(c.value);
     }},
    {data::ConditionKind::tip_faces,
     [](const Evaluator& e, const Condition& c, int place) { return e.faces(c.tool, place, std::cos(c.value)); }},
    {data::ConditionKind::tip_drops,
     [](const Evaluator& e, const Condition& c, int) { return e.dropped_m(c.tool) >= c.value; }},
    {data::ConditionKind::fed,
     [](const Evaluator& e, const Condition& c, int) { return std::fabs(e.fed_m(c.tool)) >= c.value; }},
    {data::ConditionKind::inserted,
     [](const Evaluator& e, const Condition& c, int) {
       const double inserted_m = e.session.rods.rods[index(c.tool)].inserted_m;
       return e.comes_in(c.tool) ? inserted_m >= c.value : inserted_m <= c.value;
     }},
    {data::ConditionKind::out,
     [](const Evaluator& e, const Condition& c, int) { return !e.report.tools.empty() && !e.tool(c.tool).in_body; }},
    {data::ConditionKind::turned,
     [](const Evaluator& e, const Condition& c, int) { return std::fabs(e.turned_rad(c.tool)) >= c.value; }},
    {data::ConditionKind::hub_within, [](const Evaluator& e, const Condition& c,
                                   int) { return std::fabs(e.session.hands[index(c.tool)].turned_rad) <= c.value; }},
    {data::ConditionKind::push_exceeds,
     [](const Evaluator& e, const Condition& c, int) { return std::fabs(e.state.felt[4 * index(c.tool)]) > c.value; }},
    {data::ConditionKind::torque_exceeds, [](const Evaluator& e, const Condition& c,
                                       int) { return std::fabs(e.state.felt[4 * index(c.tool) + 1]) > c.value; }},
    {data::ConditionKind::wall_force_exceeds,
     [](const Evaluator& e, const Condition& c, int) { return e.state.felt[4 * index(c.tool) + 2] > c.value; }},
    {data::ConditionKind::tip_force_exceeds,
     [](const Evaluator& e, const Condition& c, int) { return e.state.felt[4 * index(c.tool) + 3] > c.value; }},
    {data::ConditionKind::seconds,
     [](const Evaluator& e, const Condition& c, int) { return e.now_s() - e.state.began_s >= c.value; }},
    {data::ConditionKind::beats,
     [](const Evaluator& e, const Condition& c, int) {
       return e.session.blood.heart.beats + e.session.blood.heart.phase - e.state.began_beats >= c.value;
     }},
    {data::ConditionKind::balloon_at,
     [](const Evaluator& e, const Condition& c, int) { return e.balloon_is_at(c.value, c.lesion); }},
    {data::ConditionKind::balloon_within,
     [](const Evaluator& e, const Condition& c, int) { return e.balloon_is_within(c.value, c.lesion); }},
    {data::ConditionKind::balloon_clear,
     [](const Evaluator& e, const Condition& c, int) { return e.balloon_is_out_of_guide(c.value); }},
    {data::ConditionKind::balloon_open,
     [](const Evaluator& e, const Condition&, int) {
       const vascular::BalloonState& balloon = e.session.treatment.balloon;
       return e.balloon() && balloon.pressure_Pa > 101325 && waist(*e.balloon(), balloon) > 0.9;
     }},
    {data::ConditionKind::balloon_empty,
     [](const Evaluator& e, const Condition&, int) {
       return !e.balloon() || is_empty(*e.balloon(), e.session.treatment.balloon);
     }},
    {data::ConditionKind::engaged, [](const Evaluator& e, const Condition&, int place) { return e.guide_is_in(place); }},
    {data::ConditionKind::trace,
     [](const Evaluator& e, const Condition&,
        int place) { return e.session.coupling.guide >= 0 && static_cast<int>(e.session.blood.line.trace) == place; }},
    {data::ConditionKind::contrast_in,
     [](const Evaluator& e, const Condition&, int place) { return e.contrast_is_seen(place); }},
    {data::ConditionKind::flow_below, [](const Evaluator& e, const Condition& c,
                                   int) { return supply_behind_lesion(e.model, e.session, c.lesion) < c.value; }},
    {data::ConditionKind::ST_exceeds,
     [](const Evaluator& e, const Condition& c,
        int) { return ST_shift_mV(e.model.physiology.ischaemia, e.session.blood.ischaemia) > 1e3 * c.value; }},
    {data::ConditionKind::act_exceeds,
     [](const Evaluator& e, const Condition& c,
        int) { return act_s(e.model.treatment.drugs, e.session.treatment.drugs) > c.value; }},
    {data::ConditionKind::stenosis_below, [](const Evaluator& e, const Condition& c,
                                       int) { return lesion_now(e.model, e.session, c.lesion).stenosis < c.value; }},
    {data::ConditionKind::stent_beyond, [](const Evaluator& e, const Condition& c,
                                     int) { return lesion_is_covered(e.model, e.session, c.value, c.lesion); }},
    {data::ConditionKind::unharmed,
     [](const Evaluator& e, const Condition&, int) { return is_unharmed(e.model, e.session); }},
    {data::ConditionKind::systolic_below,
     [](const Evaluator& e, const Condition& c, int) { return e.session.blood.heart.beat.systolic_Pa < c.value; }},
    {data::ConditionKind::systolic_exceeds,
     [](const Evaluator& e, const Condition& c, int) { return e.session.blood.heart.beat.systolic_Pa > c.value; }},
    {data::ConditionKind::rate_below, [](const Evaluator& e, const Condition& c,
                                   int) { return 60 / e.session.blood.heart.cycle_s < c.value; }},
    {data::ConditionKind::rate_exceeds, [](const Evaluator& e, const Condition& c,
                                     int) { return 60 / e.session.blood.heart.cycle_s > c.value; }},
    {data::ConditionKind::pericardium_below,
     [](const Evaluator& e, const Condition& c,
        int) { return e.session.blood.heart.circulation.pericardium_m3 < c.value; }},
    {data::ConditionKind::pericardium_exceeds,
     [](const Evaluator& e, const Condition& c,
        int) { return e.session.blood.heart.circulation.pericardium_m3 > c.value; }},
    {data::ConditionKind::thrombus_below,
     [](const Evaluator& e, const Condition& c, int) { return volume_m3(e.session.treatment.thrombus) < c.value; }},
    {data::ConditionKind::thrombus_exceeds,
     [](const Evaluator& e, const Condition& c, int) { return volume_m3(e.session.treatment.thrombus) > c.value; }},
    {data::ConditionKind::sealed, [](const Evaluator& e, const Condition&,
                               int) { return leak_m3_s(e.session.treatment) < visible_leak_m3_s; }},
    {data::ConditionKind::pulseless,
     [](const Evaluator& e, const Condition&, int) { return e.session.blood.heart.pulseless_s > 0; }},
    {data::ConditionKind::stopped, [](const Evaluator& e, const Condition&, int) {
       return e.session.blood.heart.rhythm == vascular::Rhythm::asystole;
     }}};

/// Indexed by kind. Does not compile if a kind has no test, or two.
constexpr std::array<Test, data::condition_kinds> test_of = [] {
  static_assert(std::size(tests) == data::condition_kinds, "each kind of condition has one test");
  std::array<Test, data::condition_kinds> by_kind{};
  for (const TestOfKind& one : tests) {
    Test& place = by_kind[static_cast<std::size_t>(one.kind)];
    if (place) throw "two tests of one kind";
    place = one.holds;
  }
  return by_kind;
}();

}  // namespace

bool ConditionEvaluator::holds(const data::ScriptCondition& condition, int place) const {
  return test_of[static_cast<std::size_t>(condition.kind)](*this, condition, place);
}

int ConditionEvaluator::first_that_holds(const std::vector<data::ScriptCondition>& conditions,
                                         const std::vector<int>& at) const {
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (holds(conditions[i], at[i])) return static_cast<int>(i);
  return -1;
}

double ConditionEvaluator::now_s() const { return seconds(model, session); }

ToolReport ConditionEvaluator::tool(int tool) const {
  return report.tools.empty() ? ToolReport{} : report.tools[index(tool)];
}

double ConditionEvaluator::fed_m(int tool) const {
  return session.hands[index(tool)].fed_m - state.began_fed_m[index(tool)];
}

double ConditionEvaluator::turned_rad(int tool) const {
  return session.hands[index(tool)].turned_rad - state.began_turned_rad[index(tool)];
}

int ConditionEvaluator::tip_sphere(int tool) const {
  if (tool != located_tool_) {
    located_tool_ = tool;
    located_sphere_ =
        model.vessel->way->locate(tip(model, session, tool), session.blood.heart.phase, breath(model, session));
  }
  return located_sphere_;
}

/// True if the tip is in the body, at the place or beyond it; false if the place does not exist.
bool ConditionEvaluator::tip_is_beyond(int at, int place) const {
  return tool(at).in_body && place >= 0 && model.vessel->way->beyond(tip_sphere(at), place);
}

double ConditionEvaluator::astray_m(int tool, int place) const {
  return model.vessel->way->astray_m(tip_sphere(tool), model.vessel->way->branch(place));
}

/// Whether the tip points to the side of the vessel where the branch leaves, seen along the vessel.
bool ConditionEvaluator::faces(int tool, int branch, double cosine) const {
  const VesselIndex::Departure it = model.vessel->way->departure(branch, session.blood.heart.phase);
  const Eigen::Vector3d points = tip_direction(model, session, tool), round = points - points.dot(it.along) * it.along;
  return round.dot(it.side) >= cosine * round.norm() && it.side.norm() > 0;
}

const vascular::BalloonModel* ConditionEvaluator::balloon() const {
  const int b = session.coupling.balloon;
  return b < 0 ? nullptr : &model.treatment.balloons[static_cast<std::size_t>(b)];
}

/// A beat moves artery and shaft relative to each other by millimetres, so positions are evaluated while the heart
/// rests, before the R wave.
std::optional<double> ConditionEvaluator::balloon_at_rest_m(int lesion) const {
  if (!heart_rests(session)) return {};
  return balloon_from_lesion_m(model, session, lesion);
}

bool ConditionEvaluator::balloon_is_within(double most_m, int lesion) const {
  const auto at = balloon_at_rest_m(lesion);
  return at && std::fabs(*at) <= most_m;
}

/// Whether the tool is being advanced. Decided by the step's action; only for steps about other tools by the movement
/// so far, because a hand at a box starts some milliseconds late.
bool ConditionEvaluator::comes_in(int tool) const {
  const data::ScriptStep& step = plan.script.steps[static_cast<std::size_t>(state.step)];
  const bool own = std::count(step.tools.begin(), step.tools.end(), tool) > 0;
  if (own && step.action == data::ScriptAction::advance) return true;
  if (own && step.action == data::ScriptAction::withdraw) return false;
  return session.hands[index(tool)].fed_m >= state.began_fed_m[index(tool)];
}

/// Whether the balloon has reached the offset from the side it comes from.
bool ConditionEvaluator::balloon_is_at(double offset_m, int lesion) const {
  const auto at = balloon_at_rest_m(lesion);
  if (!at) return false;
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (model.balloon_of[t] == session.coupling.balloon)
      return comes_in(static_cast<int>(t)) ? *at >= offset_m : *at <= offset_m;
  return false;
}

bool ConditionEvaluator::balloon_is_out_of_guide(double by_m) const {
  const auto inserted_m = [&](std::size_t tool) { return session.rods.rods[tool].inserted_m; };
  const double guide_m = session.coupling.guide < 0 ? 0 : inserted_m(static_cast<std::size_t>(session.coupling.guide));
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (session.coupling.balloon >= 0 && model.balloon_of[t] == session.coupling.balloon)
      return inserted_m(t) - marker_from_tip_m(model.tools[t].instrument, 0) >= guide_m + by_m;
  return false;
}

bool ConditionEvaluator::guide_is_in(int branch) const {
  const CouplingState& b = session.coupling;
  if (b.guide < 0) return false;
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const int first = tree.branches[static_cast<std::size_t>(branch)].first;
  if (b.tip.where == vascular::TipPlace::coronary) return b.tip.cell == first || tree.is_downstream(b.tip.cell, first);
  const auto side = static_cast<std::size_t>(b.tip.where == vascular::TipPlace::right_sinus);
  return b.tip.where >= vascular::TipPlace::left_sinus && model.physiology.contrast.coronary_branch[side] == branch &&
         b.tip.into_ostium > 0.6;
}

/// Only while the beam is on.
bool ConditionEvaluator::contrast_is_seen(int cell) const {
  const double r = session.blood.radius_m[static_cast<std::size_t>(cell)];
  const double there = concentration(session.blood.contrast, model.physiology.flow, cell, units::pi * r * r);
  return there > visible_kg_m3 && (session.c_arm.fluoroscopy || session.c_arm.cine);
}

/// How far the tip moved since the oldest note, beyond the hand's movement.
double ConditionEvaluator::dropped_m(int tool) const {
  const double* notes = &state.tips[std::size_t{4} * noted_tips * static_cast<std::size_t>(tool)];
  if (!(notes[3] == notes[3])) return 0;  // NaN: not noted for long enough
  const Eigen::Vector3d then(notes[0], notes[1], notes[2]);
  const double hand = std::fabs(session.hands[static_cast<std::size_t>(tool)].fed_m - notes[3]);
  return (tip(model, session, tool) - then).norm() - hand;
}

}  // namespace ostium::app
