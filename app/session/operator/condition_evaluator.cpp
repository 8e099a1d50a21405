#include "app/session/operator/condition_evaluator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/session/coupling/tool_geometry.h"
#include "app/session/model/outcome.h"
#include "core/base/units.h"

namespace ostium::app {

namespace {

using Evaluator = ConditionEvaluator;
using Condition = data::ScriptCondition;
using Kind = data::ConditionKind;

std::size_t index(int tool) { return static_cast<std::size_t>(tool); }

bool is_beyond(const Evaluator& e, const Condition& c, int place) { return e.tip_is_beyond(c.tool, place); }

/// Tests a condition at its place.
using Test = bool (*)(const Evaluator&, const Condition&, int place);
struct TestOfKind {
  Kind kind;
  Test holds;
};

/// One per kind that is not settled by a number of `measures`, in any order.
constexpr TestOfKind tests[] = {
    {Kind::tip_passes, is_beyond},
    {Kind::tip_in, is_beyond},
    {Kind::tip_leaves,
     [](const Evaluator& e, const Condition& c, int place) { return !e.tip_is_beyond(c.tool, place); }},
    {Kind::tip_on, [](const Evaluator& e, const Condition& c,
                      int place) { return e.tool(c.tool).in_body && place >= 0 && e.astray_m(c.tool, place) == 0; }},
    {Kind::tip_astray,
     [](const Evaluator& e, const Condition& c, int place) {
       return e.tool(c.tool).in_body && place >= 0 && e.astray_m(c.tool, place) >= c.value;
     }},
    {Kind::tip_points,
     [](const Evaluator& e, const Condition& c, int) {
       return tip_direction(e.model, e.session, c.tool).dot(c.direction_P) >= std::cos(c.value);
     }},
    {Kind::tip_faces,
     [](const Evaluator& e, const Condition& c, int place) { return e.faces(c.tool, place, std::cos(c.value)); }},
    {Kind::inserted, [](const Evaluator& e, const Condition& c,
                        int) { return e.comes_in(c.tool) ? e.measured(c) >= c.value : e.measured(c) <= c.value; }},
    {Kind::out,
     [](const Evaluator& e, const Condition& c, int) { return !e.report.tools.empty() && !e.tool(c.tool).in_body; }},
    {Kind::balloon_at, [](const Evaluator& e, const Condition& c, int) { return e.balloon_is_at(c); }},
    {Kind::distal_marker_at, [](const Evaluator& e, const Condition& c, int) { return e.balloon_is_at(c); }},
    {Kind::balloon_within,
     [](const Evaluator& e, const Condition& c, int) { return heart_rests(e.session) && e.measured(c) <= c.value; }},
    {Kind::balloon_open,
     [](const Evaluator& e, const Condition&, int) {
       const BalloonInBody own = e.balloon();
       return own && own.state->pressure_Pa > 101325 && waist(e.model_of(own), *own.state) > 0.9;
     }},
    {Kind::balloon_empty, [](const Evaluator& e, const Condition&, int) { return e.balloons_are_empty(); }},
    {Kind::engaged, [](const Evaluator& e, const Condition&, int place) { return e.guide_is_in(place); }},
    {Kind::trace,
     [](const Evaluator& e, const Condition&, int place) {
       return e.session.coupling.guide >= 0 && static_cast<int>(e.session.blood.line.trace) == place;
     }},
    {Kind::contrast_in, [](const Evaluator& e, const Condition&, int place) { return e.contrast_is_seen(place); }},
    {Kind::stent_beyond, [](const Evaluator& e, const Condition& c,
                            int) { return lesion_is_covered(e.model, e.session, c.value, c.lesion); }},
    {Kind::unharmed, [](const Evaluator& e, const Condition&, int) { return is_unharmed(e.model, e.session); }},
    {Kind::sealed,
     [](const Evaluator& e, const Condition&, int) { return leak_m3_s(e.session.treatment) < visible_leak_m3_s; }},
    {Kind::pulseless, [](const Evaluator& e, const Condition&, int) { return e.session.blood.heart.pulseless_s > 0; }},
    {Kind::stopped, [](const Evaluator& e, const Condition&, int) {
       return e.session.blood.heart.rhythm == vascular::Rhythm::asystole;
     }}};

/// How a number settles a condition; `by_test`: its row of `tests` does, which looks at more.
enum class Settled { by_test, above, at_least, below, at_most };
/// In SI, as the condition's value; NaN: there is none to see.
using Measure = double (*)(const Evaluator&, const Condition&);
struct MeasureOfKind {
  Kind kind;
  Settled when;
  Measure seen;
};

/// One per kind that is about a number, in any order.
constexpr MeasureOfKind measures[] = {
    {Kind::tip_drops, Settled::at_least, [](const Evaluator& e, const Condition& c) { return e.dropped_m(c.tool); }},
    {Kind::fed, Settled::at_least, [](const Evaluator& e, const Condition& c) { return std::fabs(e.fed_m(c.tool)); }},
    {Kind::inserted, Settled::by_test,
     [](const Evaluator& e, const Condition& c) { return e.session.rods.rods[index(c.tool)].inserted_m; }},
    {Kind::turned, Settled::at_least,
     [](const Evaluator& e, const Condition& c) { return std::fabs(e.turned_rad(c.tool)); }},
    {Kind::hub_within, Settled::at_most,
     [](const Evaluator& e, const Condition& c) { return std::fabs(e.session.hands[index(c.tool)].turned_rad); }},
    {Kind::push_exceeds, Settled::above,
     [](const Evaluator& e, const Condition& c) { return std::fabs(e.state.felt[4 * index(c.tool)]); }},
    {Kind::torque_exceeds, Settled::above,
     [](const Evaluator& e, const Condition& c) { return std::fabs(e.state.felt[4 * index(c.tool) + 1]); }},
    {Kind::wall_force_exceeds, Settled::above,
     [](const Evaluator& e, const Condition& c) { return e.state.felt[4 * index(c.tool) + 2]; }},
    {Kind::tip_force_exceeds, Settled::above,
     [](const Evaluator& e, const Condition& c) { return e.state.felt[4 * index(c.tool) + 3]; }},
    {Kind::seconds, Settled::at_least,
     [](const Evaluator& e, const Condition&) { return e.now_s() - e.state.began_s; }},
    {Kind::beats, Settled::at_least,
     [](const Evaluator& e, const Condition&) {
       return e.session.blood.heart.beats + e.session.blood.heart.phase - e.state.began_beats;
     }},
    {Kind::balloon_at, Settled::by_test,
     [](const Evaluator& e, const Condition& c) { return e.balloon_from_lesion(c.lesion); }},
    {Kind::balloon_within, Settled::by_test,
     [](const Evaluator& e, const Condition& c) { return std::fabs(e.balloon_from_lesion(c.lesion)); }},
    {Kind::balloon_spans, Settled::at_least,
     [](const Evaluator& e, const Condition& c) {
       return balloon_beyond_lesion_m(e.model, e.session, c.lesion, e.balloon_tool())
           .value_or(std::numeric_limits<double>::quiet_NaN());
     }},
    {Kind::distal_marker_at, Settled::by_test,
     [](const Evaluator& e, const Condition& c) { return e.distal_marker_beyond_m(c.place); }},
    {Kind::balloon_clear, Settled::at_least,
     [](const Evaluator& e, const Condition&) { return e.balloon_beyond_guide_m(); }},
    {Kind::flow_below, Settled::below,
     [](const Evaluator& e, const Condition& c) { return supply_behind_lesion(e.model, e.session, c.lesion); }},
    {Kind::ST_exceeds, Settled::above,
     [](const Evaluator& e, const Condition&) {
       return 1e-3 * ST_shift_mV(e.model.physiology.ischaemia, e.session.blood.ischaemia);
     }},
    {Kind::act_exceeds, Settled::above,
     [](const Evaluator& e, const Condition&) { return act_s(e.model.treatment.drugs, e.session.treatment.drugs); }},
    {Kind::stenosis_below, Settled::below,
     [](const Evaluator& e, const Condition& c) { return lesion_now(e.model, e.session, c.lesion).stenosis; }},
    {Kind::systolic_below, Settled::below,
     [](const Evaluator& e, const Condition&) { return e.session.blood.heart.beat.systolic_Pa; }},
    {Kind::systolic_exceeds, Settled::above,
     [](const Evaluator& e, const Condition&) { return e.session.blood.heart.beat.systolic_Pa; }},
    {Kind::rate_below, Settled::below,
     [](const Evaluator& e, const Condition&) { return 60 / e.session.blood.heart.cycle_s; }},
    {Kind::rate_exceeds, Settled::above,
     [](const Evaluator& e, const Condition&) { return 60 / e.session.blood.heart.cycle_s; }},
    {Kind::pericardium_below, Settled::below,
     [](const Evaluator& e, const Condition&) { return e.session.blood.heart.circulation.pericardium_m3; }},
    {Kind::pericardium_exceeds, Settled::above,
     [](const Evaluator& e, const Condition&) { return e.session.blood.heart.circulation.pericardium_m3; }},
    {Kind::thrombus_below, Settled::below,
     [](const Evaluator& e, const Condition&) { return volume_m3(e.session.treatment.thrombus); }},
    {Kind::thrombus_exceeds, Settled::above,
     [](const Evaluator& e, const Condition&) { return volume_m3(e.session.treatment.thrombus); }}};

/// Of one kind: `test` or `measure.when` settles it.
struct Settles {
  Test test;
  Settled when;
  Measure seen;
};

/// Indexed by kind. Does not compile if nothing, or two, settle a kind. All zero at first: GCC 12 forgets other values
/// of elements that are skipped.
constexpr std::array<Settles, data::condition_kinds> settles_kind = [] {
  std::array<Settles, data::condition_kinds> by_kind{};
  for (const MeasureOfKind& one : measures) {
    Settles& place = by_kind[static_cast<std::size_t>(one.kind)];
    if (place.seen) throw "two measures of one kind";
    place.when = one.when, place.seen = one.seen;
  }
  for (const TestOfKind& one : tests) {
    Settles& place = by_kind[static_cast<std::size_t>(one.kind)];
    if (place.test || place.when != Settled::by_test) throw "two tests of one kind";
    place.test = one.holds;
  }
  for (const Settles& place : by_kind)
    if (!place.test && place.when == Settled::by_test) throw "a kind without a test";
  return by_kind;
}();

const Settles& settles(const Condition& condition) { return settles_kind[static_cast<std::size_t>(condition.kind)]; }

}  // namespace

bool ConditionEvaluator::holds(const data::ScriptCondition& condition, int place) const {
  switch (settles(condition).when) {
    case Settled::above:
      return measured(condition) > condition.value;
    case Settled::at_least:
      return measured(condition) >= condition.value;
    case Settled::below:
      return measured(condition) < condition.value;
    case Settled::at_most:
      return measured(condition) <= condition.value;
    case Settled::by_test:
      return settles(condition).test(*this, condition, place);
  }
  return false;
}

double ConditionEvaluator::measured(const data::ScriptCondition& condition) const {
  const Measure seen = settles(condition).seen;
  return seen ? seen(*this, condition) : std::numeric_limits<double>::quiet_NaN();
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

int ConditionEvaluator::balloon_tool() const {
  const auto at = static_cast<std::size_t>(state.step);
  if (at >= plan.script.steps.size()) return -1;
  for (const int tool : plan.script.steps[at].tools)
    if (place_of(session.coupling, tool) >= 0) return tool;
  return -1;
}

BalloonInBody ConditionEvaluator::balloon() const {
  const int tool = balloon_tool();
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (const BalloonInBody own = balloon_in_body(session.coupling, session.treatment, {}, nth);
        own && (tool < 0 || own.place->tool == tool))
      return own;
  return {};
}

const vascular::BalloonModel& ConditionEvaluator::model_of(const BalloonInBody& own) const {
  return model.treatment.balloons[static_cast<std::size_t>(own.place->balloon)];
}

bool ConditionEvaluator::balloons_are_empty() const {
  const int tool = balloon_tool();
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (const BalloonInBody own = balloon_in_body(session.coupling, session.treatment, {}, nth);
        own && (tool < 0 || own.place->tool == tool) && !is_empty(model_of(own), *own.state))
      return false;
  return true;
}

double ConditionEvaluator::balloon_from_lesion(int lesion) const {
  return balloon_from_lesion_m(model, session, lesion, balloon_tool())
      .value_or(std::numeric_limits<double>::quiet_NaN());
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
bool ConditionEvaluator::balloon_is_at(const data::ScriptCondition& c) const {
  if (!heart_rests(session)) return false;
  const double at_m = measured(c);
  const BalloonInBody own = balloon();
  return own && (comes_in(own.place->tool) ? at_m >= c.value : at_m <= c.value);
}

double ConditionEvaluator::distal_marker_beyond_m(const std::string& branch) const {
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const BalloonInBody own = balloon();
  const int b = tree.branch(branch);
  if (!own || own.place->branch < 0 || b < 0) return std::numeric_limits<double>::quiet_NaN();
  const vascular::VesselPath& path = model.treatment.paths[index(own.place->branch)];
  const auto at = std::find(path.cells.begin(), path.cells.end(), tree.branches[index(b)].parent_cell);
  if (at == path.cells.end()) return std::numeric_limits<double>::quiet_NaN();
  const double leaves_m = path.s_m[static_cast<std::size_t>(at - path.cells.begin())];
  return own.state->seat_m + model_of(own).length_m / 2 - leaves_m;
}

/// Of its proximal marker from the guide's tip; NaN: no balloon is in the body.
double ConditionEvaluator::balloon_beyond_guide_m() const {
  const auto inserted_m = [&](std::size_t tool) { return session.rods.rods[tool].inserted_m; };
  const double guide_m = session.coupling.guide < 0 ? 0 : inserted_m(static_cast<std::size_t>(session.coupling.guide));
  const BalloonInBody own = balloon();
  if (!own) return std::numeric_limits<double>::quiet_NaN();
  const auto t = static_cast<std::size_t>(own.place->tool);
  return inserted_m(t) - marker_from_tip_m(model.tools[t].instrument, 0) - guide_m;
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

double ConditionEvaluator::contrast_kg_m3(int cell) const {
  const double r = session.blood.radius_m[static_cast<std::size_t>(cell)];
  return concentration(session.blood.contrast, model.physiology.flow, cell, units::pi * r * r);
}

bool ConditionEvaluator::contrast_is_seen(int cell) const {
  return beam_is_on() && contrast_kg_m3(cell) > visible_kg_m3;
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
