#include "app/session/operator/operator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "app/session/operator/condition_evaluator.h"
#include "app/session/operator/operator_actions.h"
#include "core/base/units.h"
#include "data/assessment/metrics.h"
#include "data/formats/load_error.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

/// The flow tree's cell nearest to a sphere of the vessel index, or -1.
int cell_at(const Coronaries& c, const VesselIndex& way, int sphere) {
  const Eigen::Vector3d p = way.p(sphere, 0);
  int best = -1;
  double least = 4e-3;
  for (std::size_t cell = 0; cell < c.tree().cells.size(); ++cell)
    if (const double d = (c.map.coronary.position(cell, 0) - p).norm(); d < least)
      least = d, best = static_cast<int>(cell);
  return best;
}

/// Refuses a condition about something this session does not have.
void require_subject(const data::ScriptCondition& c, const SessionModel& model) {
  if (needs_patient(c.kind) && !model.has_patient())
    refuse(c, c.words + ": no blood flows in this vessel; expected a case whose coronary arteries leave an aorta");
  if (!is_about_a_lesion(c.kind)) return;
  if (const std::size_t n = model.vessel->coronaries->lesions.size(); static_cast<std::size_t>(c.lesion) >= n)
    refuse(c, n == 0 ? c.words + ": this patient has no lesion"
                     : fmt::format("{}: this patient's lesions are {}", c.words, n));
}

[[noreturn]] void refuse_place(const data::Script& script, const data::ScriptCondition& c, const VesselIndex& way) {
  std::string known;
  for (const std::string& name : way.places()) known += (known.empty() ? "" : ", ") + name;
  for (const data::ScriptLandmark& landmark : script.landmarks) known += ", " + landmark.name;
  refuse(c, fmt::format("there is no place \"{}\" in this vessel; expected one of: {}; or with millimetres beyond a "
                        "branch's origin, as RCA+20, or before it leaves its vessel, as D1-4",
                        c.place, known));
}

/// A landmark of the script, or a place of the vessel; -1: there is none.
int place_called(const data::Script& script, const std::string& name, const VesselIndex& way) {
  int place = -1;
  for (const data::ScriptLandmark& landmark : script.landmarks)
    if (landmark.name == name) place = way.nearest(landmark.p_P);
  return place < 0 ? way.place(name) : place;
}

/// Resolves a condition's place in this session: a sphere of the vessel index, a branch, a flow cell or a trace; -1:
/// none.
int place_of(const data::Script& script, const data::ScriptCondition& c, const SessionModel& model) {
  const VesselIndex& way = *model.vessel->way;
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  int place = -1;
  switch (row_of(c.kind).value) {
    case data::ConditionValue::pressure_trace:
      for (int t = 0; t < 5; ++t)
        if (trace_name(static_cast<vascular::Trace>(t)) == c.place) place = t;
      return place;
    case data::ConditionValue::ostium:
      place = tree.branch(c.place);
      if (place < 0 || tree.branches[static_cast<std::size_t>(place)].parent >= 0)
        refuse(c, c.words + ": expected an artery that leaves the aorta, LM or RCA");
      return place;
    case data::ConditionValue::branch:
      if (c.kind == data::ConditionKind::distal_marker_at && tree.branch(c.place) < 0)
        refuse(c, c.words + ": expected a branch of the coronary arteries");
      place = way.entry(c.place);
      break;
    case data::ConditionValue::place:
    case data::ConditionValue::contrast:
      place = place_called(script, c.place, way);
      break;
    default:
      return -1;
  }
  if (place < 0 && !c.if_there) refuse_place(script, c, way);
  if (row_of(c.kind).value != data::ConditionValue::contrast) return place;
  const int cell = cell_at(*model.vessel->coronaries, way, place);
  if (cell < 0) refuse(c, c.words + ": contrast is looked for in coronary arteries alone");
  return cell;
}

[[noreturn]] void refuse_step(const data::Script& script, const data::ScriptStep& step, const std::string& what) {
  throw data::LoadError(fmt::format("{}:{}: {}", script.file, step.line, what));
}

/// Without, the step would be done at once, or never.
void require_tool(const data::Script& script, const data::ScriptStep& step, const SessionModel& model) {
  using Action = data::ScriptAction;
  const auto none = [&](auto fits) { return std::none_of(model.tools.begin(), model.tools.end(), fits); };
  if ((step.action == Action::inflate || step.action == Action::deflate) &&
      none([](const SessionTool& tool) { return tool.instrument.balloon.has_value(); }))
    refuse_step(script, step, step.words() + ": no tool has a balloon; expected a balloon or a stent among the tools");
  if (step.action == Action::inflate || step.action == Action::deflate)
    for (const int t : step.tools)
      if (const SessionTool& tool = model.tools[static_cast<std::size_t>(t)]; !tool.instrument.balloon)
        refuse_step(script, step, step.words() + ": " + tool.name + " has no balloon; expected a tool that has one");
  if (step.action == Action::breathe && !(model.breaths_1_min > 0))
    refuse_step(script, step, step.words() + ": this patient does not breathe; expected --set breathing=12 or so");
  const bool air = step.action == Action::provoke && step.complication == static_cast<int>(vascular::Provoked::air);
  if ((needs_catheter(step.action) || air) &&
      none([](const SessionTool& tool) { return is_catheter(tool.instrument); }))
    refuse_step(script, step, step.words() + ": no tool is a catheter for it; expected one among the tools");
}

/// The flow cell of a step's `at`, or the index of its drug; refuses what this session does not have.
int subject_of(const data::Script& script, const data::ScriptStep& step, const SessionModel& model) {
  if (needs_patient(step.action) && !model.has_patient())
    refuse_step(
        script, step,
        step.words() + ": no blood flows in this vessel; expected a case whose coronary arteries leave an aorta");
  require_tool(script, step, model);
  if (step.action == data::ScriptAction::give) return find_drug(step, model.treatment.drugs, script);
  if (step.at.empty()) return -1;
  const VesselIndex& way = *model.vessel->way;
  const int place = place_called(script, step.at, way);
  const int cell = place < 0 ? -1 : cell_at(*model.vessel->coronaries, way, place);
  if (cell < 0)
    refuse_step(script, step,
                step.at +
                    ": there is no such place in a coronary artery; expected millimetres beyond a "
                    "branch's origin, as RCA+20");
  return cell;
}

std::vector<int> places(const data::Script& script, const std::vector<data::ScriptCondition>& conditions,
                        const SessionModel& model) {
  std::vector<int> out;
  for (const data::ScriptCondition& c : conditions) {
    require_subject(c, model);
    out.push_back(place_of(script, c, model));
  }
  return out;
}

/// A script would find its way, choose sizes by another artery's lesion, and treat what is healthy.
void require_lesions(const data::Script& script, const SessionModel& model) {
  if (script.by_hand || script.lesions_in.empty()) return;
  std::vector<std::string> there;
  if (model.vessel->patient)
    for (const vascular::Lesion& lesion : model.vessel->patient->lesions) there.push_back(lesion.branch);
  for (const std::string& branch : script.lesions_in)
    if (std::ranges::find(there, branch) == there.end())
      throw data::LoadError(fmt::format("{}: treats a lesion of {}, and {} has {}; expected a case with lesions in: {}",
                                        script.file, branch, model.vessel->name,
                                        there.empty() ? "none" : fmt::format("lesions in: {}", fmt::join(there, ", ")),
                                        fmt::join(script.lesions_in, ", ")));
}

/// Random factor on the hand's speed in a step: log-normal, 15 %.
double hand_factor(std::uint64_t seed, int step) {
  if (seed == 0) return 1;
  std::mt19937_64 random(seed * 1000003 + static_cast<std::uint64_t>(step));
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const double u = uniform(), v = uniform();
  return std::exp(0.15 * std::sqrt(-2 * std::log(u)) * std::cos(2 * units::pi * v));
}

void forget_tips(OperatorState& state) { std::fill(state.tips.begin(), state.tips.end(), std::nan("")); }

void note_tips(const SessionModel& model, const SessionState& session, OperatorState& state) {
  const double now = seconds(model, session);
  if (now < state.next_s - 1e-9) return;
  state.next_s = now + note_every_s;
  for (int t = 0; t < static_cast<int>(model.tools.size()); ++t) {
    double* notes = &state.tips[std::size_t{4} * noted_tips * static_cast<std::size_t>(t)];
    std::copy(notes + 4, notes + 4 * noted_tips, notes);
    double* last = notes + 4 * (noted_tips - 1);
    const Vector3d p = tip(model, session, t);
    last[0] = p.x(), last[1] = p.y(), last[2] = p.z(), last[3] = session.hands[static_cast<std::size_t>(t)].fed_m;
  }
}

/// Forces low-pass filtered, as a hand feels no millisecond peaks. Steps with trouble are skipped: their forces are not
/// physical.
void feel(const SessionModel& model, const SessionReport& report, OperatorState& state) {
  if (report.rods.trouble & (core::not_converged | core::motion_lost | core::no_solution | core::pulled_apart)) return;
  const double share = 1 - std::exp(-2 * units::pi * data::wall_force_cut_off_Hz * model.step_s());
  for (std::size_t t = 0; t < report.tools.size(); ++t) {
    const ToolReport& tool = report.tools[t];
    const double now[] = {tool.push_N, tool.torque_Nm, tool.wall_force_N, tool.tip_force_N};
    for (std::size_t k = 0; k < 4; ++k) state.felt[4 * t + k] += share * (now[k] - state.felt[4 * t + k]);
  }
}

void begin(const ScriptPlan& plan, const SessionModel& model, const SessionState& session, OperatorState& state) {
  const data::ScriptStep& step = plan.script.steps[static_cast<std::size_t>(state.step)];
  state.began = false;
  state.began_s = seconds(model, session);
  state.began_beats = session.blood.heart.beats + session.blood.heart.phase;
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    state.began_fed_m[t] = session.hands[t].fed_m, state.began_turned_rad[t] = session.hands[t].turned_rad;
  forget_tips(state);
  begin_action(step, plan.subjects[static_cast<std::size_t>(state.step)], session, state);
}

void ask(const ScriptPlan& plan, const OperatorState& state, SessionInputs& inputs) {
  for (ToolInputs& tool : inputs.tools) tool = {};
  inputs.rate_1_min = state.rate_1_min;
  inputs.c_arm = {state.lao_rad, state.cran_rad, state.field_m, state.p_PI, state.fluoroscopy, state.cine};
  inputs.delivery = state.given;
  inputs.delivery.injection_m3_s = state.injection_m3_s, inputs.delivery.iodine_kg_m3 = state.iodine_kg_m3;
  inputs.delivery.gauge_Pa = state.gauge_Pa[0], inputs.delivery.second_gauge_Pa = state.gauge_Pa[1];
  const auto s = static_cast<std::size_t>(state.step);
  if (state.outcome != Outcome::running || s >= plan.script.steps.size()) return;
  const double factor = plan.hand_speed * hand_factor(plan.seed, static_cast<int>(s));
  for (int t : plan.script.steps[s].tools)
    inputs.tools[static_cast<std::size_t>(t)] = {factor * plan.script.steps[s].feed_m_s,
                                                 factor * plan.script.steps[s].turn_rad_s};
}

void end(Outcome outcome, int condition, OperatorState& state) {
  state.outcome = outcome;
  state.by_condition = condition;
}

void go_to(int step, OperatorState& state) { state.step = step, state.began = true; }

/// The step that `s` jumps to when it fails; -1: none. `tries` counts its jumps, including the last resort.
int leads_to(const data::Script& script, int s, int& tries) {
  const data::ScriptStep& step = script.steps[static_cast<std::size_t>(s)];
  if (step.otherwise == data::ScriptStep::Otherwise::go_on)
    return static_cast<int>(script.after(static_cast<std::size_t>(s)));
  if (step.otherwise == data::ScriptStep::Otherwise::fail) return -1;
  const bool last = step.last_resort >= 0 && tries == step.tries;
  if (!last && tries >= (step.last_resort >= 0 ? 2 * step.tries + 1 : step.tries)) return -1;
  tries += 1;
  return last ? step.last_resort : step.jump_to;
}

}  // namespace

ScriptPlan make_plan(const data::Script& script, const SessionModel& model, std::uint64_t seed) {
  require_lesions(script, model);
  for (const data::ScriptLandmark& landmark : script.landmarks)
    if (model.vessel->way->place(landmark.name) >= 0)
      throw data::LoadError(
          fmt::format("{}:{}: there is a place \"{}\" in this vessel; expected another name for the landmark",
                      script.file, landmark.line, landmark.name));
  ScriptPlan plan{
      .script = script, .until_places = {}, .unless_places = {}, .subjects = {}, .seed = seed, .hand_speed = 1};
  for (const data::ScriptStep& step : script.steps) {
    plan.until_places.push_back(places(script, step.until, model));
    plan.unless_places.push_back(places(script, step.unless, model));
    plan.subjects.push_back(subject_of(script, step, model));
  }
  return plan;
}

OperatorState make_state(const ScriptPlan& plan, const SessionModel& model) {
  OperatorState state;
  state.began_fed_m.assign(model.tools.size(), 0), state.began_turned_rad.assign(model.tools.size(), 0);
  state.tries.assign(plan.script.steps.size(), 0);
  state.felt.assign(4 * model.tools.size(), 0);
  state.tips.assign(4 * noted_tips * model.tools.size(), 0);
  forget_tips(state);
  state.rate_1_min = model.vessel->rate_1_min;
  state.p_PI = model.vessel->p_middle;
  return state;
}

std::vector<double> save(const OperatorState& state) {
  std::vector<double> out(core::count_fields(state));
  core::put_fields(state, out.data());
  return out;
}

void restore(const std::vector<double>& saved, OperatorState& state) {
  if (saved.size() != core::count_fields(state))
    throw std::invalid_argument("the operator's saved state is another script's");
  core::take_fields(saved.data(), state);
}

Outcome decide(const ScriptPlan& plan, const SessionModel& model, const SessionState& session,
               const SessionReport& report, OperatorState& state, SessionInputs& inputs,
               std::vector<OperatorEvent>& events) {
  events.clear();
  feel(model, report, state);
  forget_what_is_given_once(state.given);
  state.given.infusion_m3_s = state.given.drain_m3_s = state.given.compressions_1_min = 0;
  state.given.aspiration_m3_s = 0;
  using Kind = OperatorEvent::Kind;
  const ConditionEvaluator evaluator(plan, model, session, report, state);
  const int count = static_cast<int>(plan.script.steps.size());
  // A step that takes no time is followed by the next at once; `count` limits jumps among such steps.
  for (int guard = 0; guard <= count && state.outcome == Outcome::running; ++guard) {
    const int s = state.step;
    if (s >= count) {
      end(Outcome::success, -1, state);
      break;
    }
    const data::ScriptStep& step = plan.script.steps[static_cast<std::size_t>(s)];
    if (state.began) {
      begin(plan, model, session, state);
      events.push_back({step.action == data::ScriptAction::mark ? Kind::marked : Kind::begins, s, -1});
      if (takes_time(step)) break;
    }
    const int until = evaluator.first_that_holds(step.until, plan.until_places[static_cast<std::size_t>(s)]);
    if (!takes_time(step) || until >= 0 || is_over(step, evaluator)) {
      if (until >= 0) events.push_back({Kind::done, s, until});
      go_to(static_cast<int>(plan.script.after(static_cast<std::size_t>(s))), state);
      continue;
    }
    const int unless = evaluator.first_that_holds(step.unless, plan.unless_places[static_cast<std::size_t>(s)]);
    const bool late = evaluator.now_s() - state.began_s >= step.timeout_s;
    if (unless < 0 && !late) break;
    events.push_back({unless >= 0 ? Kind::failed : Kind::timed_out, s, unless});
    const int next = leads_to(plan.script, s, state.tries[static_cast<std::size_t>(s)]);
    if (next >= 0)
      go_to(next, state);
    else
      end(unless >= 0 ? Outcome::failure : Outcome::timed_out, unless, state);
  }
  // Of a script a tool in the way is the end; people see it, and draw that tool out first.
  if (report.refused >= 0 && !plan.script.by_hand && state.outcome == Outcome::running) {
    state.in_the_way = report.in_its_way;
    end(Outcome::failure, -1, state);
  }
  note_tips(model, session, state);
  state.injection_m3_s = 0;
  if (state.outcome == Outcome::running && state.step < count)
    continue_action(plan.script.steps[static_cast<std::size_t>(state.step)], session, evaluator.now_s(), state);
  ask(plan, state, inputs);
  return state.outcome;
}

}  // namespace ostium::app
