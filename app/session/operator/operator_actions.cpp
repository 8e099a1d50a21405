#include "app/session/operator/operator_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/units.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

constexpr double vacuum_Pa = 101325;

using Step = data::ScriptStep;
/// The functions of an action; null if not needed. Tool movements are not here: they are set in every step's inputs.
struct Handling {
  data::ScriptAction action;
  void (*begin)(const Step&, const SessionState&, OperatorState&) = nullptr;
  void (*go_on)(const Step&, const SessionState&, double now_s, OperatorState&) = nullptr;
  bool (*is_over)(const Step&, const ConditionEvaluator&) = nullptr;  ///< for actions that end by themselves
  /// For actions that end once `volume_m3` has passed: what has passed so far through the line or drain they use.
  double (*moved_m3)(const SessionState&) = nullptr;
};

void move_c_arm(const Step& step, const SessionState&, OperatorState& state) {
  state.lao_rad = step.lao_rad.value_or(state.lao_rad), state.cran_rad = step.cran_rad.value_or(state.cran_rad);
  state.field_m = step.field_m.value_or(state.field_m), state.p_PI = step.table_P.value_or(state.p_PI);
}

double injected_m3(const SessionState& session) { return session.blood.contrast.injected_m3; }

void press_syringe(const Step& step, const SessionState& session, double, OperatorState& state) {
  if (injected_m3(session) - state.began_moved_m3 < step.volume_m3) state.injection_m3_s = step.rate_m3_s;
}

/// Whether the step is about the balloon that came in as the nth: that of its tool, or all. A device without a balloon
/// is the first.
bool is_about(const Step& step, const SessionState& session, int nth) {
  const BalloonInBody own = balloon_in_body(session.coupling, session.treatment, {}, nth);
  if (step.tools.empty()) return own || nth == 0;
  return own && own.place->tool == step.tools.front();
}

void remember_gauges(const Step&, const SessionState&, OperatorState& state) { state.began_gauge_Pa = state.gauge_Pa; }

void screw_inflation_devices(const Step& step, const SessionState& session, double now_s, OperatorState& state) {
  const double part = std::min(1.0, (now_s - state.began_s) / step.over_s);
  for (int nth = 0; nth < vascular::most_balloons; ++nth) {
    if (!is_about(step, session, nth)) continue;
    const double began_Pa = state.began_gauge_Pa[nth];
    state.gauge_Pa[nth] = part < 1 ? began_Pa + part * (step.gauge_Pa - began_Pa) : step.gauge_Pa;
  }
}

/// As is_about, without an inflation device that has no balloon in the body.
bool inflates(const Step& step, const SessionState& session, int nth) {
  return is_about(step, session, nth) && balloon_in_body(session.coupling, session.treatment, {}, nth);
}

bool any_inflates(const Step& step, const SessionState& session) {
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (inflates(step, session, nth)) return true;
  return false;
}

bool all_show(const Step& step, const ConditionEvaluator& e) {
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (inflates(step, e.session, nth) && e.state.gauge_Pa[nth] != step.gauge_Pa) return false;
  return any_inflates(step, e.session);
}

void draw_back(const Step& step, const SessionState& session, OperatorState& state) {
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (is_about(step, session, nth)) state.gauge_Pa[nth] = -vacuum_Pa;
}

void give_drug(const Step& step, const SessionState&, OperatorState& state) {
  state.given.heparin_U = step.heparin_U, state.given.nitrate_ug = step.nitrate_ug;
  state.given.adenosine_ug = step.adenosine_ug;
}

void provoke(const Step& step, const SessionState&, OperatorState& state) {
  state.given.provoked = step.complication;
  state.given.provoked_size = step.size;
}

/// One per action, in any order.
constexpr Handling handlings[] = {
    {.action = data::ScriptAction::advance},
    {.action = data::ScriptAction::withdraw},
    {.action = data::ScriptAction::turn},
    {.action = data::ScriptAction::wait},
    {.action = data::ScriptAction::mark},
    {.action = data::ScriptAction::view, .begin = move_c_arm},
    {.action = data::ScriptAction::fluoroscopy,
     .begin = [](const Step& step, const SessionState&, OperatorState& state) { state.fluoroscopy = step.on; }},
    {.action = data::ScriptAction::cine,
     .begin = [](const Step& step, const SessionState&, OperatorState& state) { state.cine = step.on; }},
    {.action = data::ScriptAction::heart_rate,
     .begin = [](const Step& step, const SessionState&, OperatorState& state) { state.rate_1_min = step.rate_1_min; }},
    {.action = data::ScriptAction::inject,
     .begin = [](const Step& step, const SessionState&,
                 OperatorState& state) { state.iodine_kg_m3 = step.iodine_kg_m3; },
     .go_on = press_syringe,
     .moved_m3 = injected_m3},
    {.action = data::ScriptAction::aspirate,
     .go_on = [](const Step& step, const SessionState&, double,
                 OperatorState& state) { state.given.aspiration_m3_s = step.rate_m3_s; },
     .moved_m3 = [](const SessionState& session) { return session.blood.heart.circulation.drawn_m3; }},
    {.action = data::ScriptAction::inflate,
     .begin = remember_gauges,
     .go_on = screw_inflation_devices,
     .is_over = all_show},
    {.action = data::ScriptAction::deflate,
     .begin = draw_back,
     .is_over = [](const Step& step,
                   const ConditionEvaluator& e) { return any_inflates(step, e.session) && e.balloons_are_empty(); }},
    {.action = data::ScriptAction::drug, .begin = give_drug},
    {.action = data::ScriptAction::give,
     .begin = [](const Step& step, const SessionState&, OperatorState& state) { state.given.drug_dose = step.dose; }},
    {.action = data::ScriptAction::infuse,
     .go_on = [](const Step& step, const SessionState&, double,
                 OperatorState& state) { state.given.infusion_m3_s = step.rate_m3_s; },
     .moved_m3 = [](const SessionState& session) { return session.blood.heart.circulation.infused_m3; }},
    {.action = data::ScriptAction::drain,
     .go_on = [](const Step& step, const SessionState&, double,
                 OperatorState& state) { state.given.drain_m3_s = step.rate_m3_s; },
     .is_over = [](const Step&,
                   const ConditionEvaluator& e) { return e.session.blood.heart.circulation.pericardium_m3 <= 0; },
     .moved_m3 = [](const SessionState& session) { return session.blood.heart.circulation.drained_m3; }},
    {.action = data::ScriptAction::shock,
     .begin = [](const Step& step, const SessionState&, OperatorState& state) { state.given.shock_J = step.energy_J; }},
    {.action = data::ScriptAction::compress,
     .go_on = [](const Step& step, const SessionState&, double,
                 OperatorState& state) { state.given.compressions_1_min = step.rate_1_min; }},
    {.action = data::ScriptAction::pace,
     .begin =
         [](const Step& step, const SessionState&, OperatorState& state) {
           state.given.pacing_1_min = step.rate_1_min, state.given.pacing_mA = step.current_mA;
         }},
    {.action = data::ScriptAction::breathe,
     .begin = [](const Step& step, const SessionState&,
                 OperatorState& state) { state.given.breath_asked = step.breath_asked; }},
    {.action = data::ScriptAction::provoke, .begin = provoke}};

/// Indexed by action. Does not compile if an action has no handling, or two.
constexpr std::array<Handling, data::action_kinds> handling_of = [] {
  static_assert(std::size(handlings) == data::action_kinds, "each action has one handling");
  std::array<Handling, data::action_kinds> by_action{};
  std::array<bool, data::action_kinds> filled{};
  for (const Handling& one : handlings) {
    const auto at = static_cast<std::size_t>(one.action);
    if (filled[at]) throw "two handlings of one action";
    filled[at] = true, by_action[at] = one;
  }
  return by_action;
}();

const Handling& handling(const data::ScriptStep& step) { return handling_of[static_cast<std::size_t>(step.action)]; }

/// "12", "12 and 8", "no balloon is in the body".
std::string gauges(const Step& step, const ConditionEvaluator& e) {
  std::string out;
  for (int nth = 0; nth < vascular::most_balloons; ++nth)
    if (inflates(step, e.session, nth))
      out += fmt::format("{}{:.3g}", out.empty() ? "" : " and ", e.state.gauge_Pa[nth] / vacuum_Pa);
  if (!out.empty()) return out;
  return step.tools.empty() ? "no balloon is in the body" : "its balloon is not in the body";
}

}  // namespace

int find_drug(const data::ScriptStep& step, const vascular::DrugModel& drugs, const data::Script& script) {
  std::string known;
  for (std::size_t d = 0; d < drugs.others.size(); ++d) {
    const vascular::Drug& drug = drugs.others[d];
    known += (known.empty() ? "" : ", ") + drug.name;
    if (drug.name != step.drug) continue;
    if (drug.unit != step.dose_unit || step.dose < drug.least || step.dose > drug.most)
      throw data::LoadError(fmt::format("{}:{}: {} {} of {}; expected dose_{}, {:g} to {:g}", script.file, step.line,
                                        step.dose, step.dose_unit, drug.name, drug.unit, drug.least, drug.most));
    return static_cast<int>(d);
  }
  throw data::LoadError(
      fmt::format("{}:{}: there is no drug \"{}\"; expected one of {}, or the action drug with "
                  "heparin_U, nitrate_ug or adenosine_ug",
                  script.file, step.line, step.drug, known));
}

void begin_action(const data::ScriptStep& step, int subject, const SessionState& session, OperatorState& state) {
  if (handling(step).begin) handling(step).begin(step, session, state);
  if (handling(step).moved_m3) state.began_moved_m3 = handling(step).moved_m3(session);
  if (step.action == data::ScriptAction::provoke) state.given.provoked_cell = subject;
  if (step.action == data::ScriptAction::give) state.given.drug = subject;
}

void continue_action(const data::ScriptStep& step, const SessionState& session, double now_s, OperatorState& state) {
  if (handling(step).go_on) handling(step).go_on(step, session, now_s, state);
}

bool takes_time(const data::ScriptStep& step) {
  return !step.until.empty() || handling(step).is_over || handling(step).moved_m3;
}

bool is_over(const data::ScriptStep& step, const ConditionEvaluator& e) {
  if (!step.until.empty()) return false;
  const Handling& how = handling(step);
  if (how.moved_m3 && how.moved_m3(e.session) - e.state.began_moved_m3 >= step.volume_m3) return true;
  return how.is_over && how.is_over(step, e);
}

std::string end_of_action(const data::ScriptStep& step, const ConditionEvaluator& e) {
  if (handling(step).moved_m3)
    return fmt::format("volume_mL {:g} (now {:.3g})", step.volume_m3 / units::mL,
                       (handling(step).moved_m3(e.session) - e.state.began_moved_m3) / units::mL);
  if (step.action == data::ScriptAction::inflate)
    return fmt::format("gauge_atm {:g} (now {})", step.gauge_Pa / vacuum_Pa, gauges(step, e));
  return any_inflates(step, e.session) ? "an empty balloon" : "an empty balloon (no balloon is in the body)";
}

}  // namespace ostium::app
