#pragma once
/// The operator of a script: looks at the session, moves the hands. All that it remembers is in OperatorState; what
/// it asks for is SessionInputs, as from any hand.
#include <string>
#include <vector>

#include "app/session/session.h"
#include "data/script.h"

namespace ostium {

/// A script whose places are known in a vessel.
struct ScriptPlan {
  Script script;
  std::vector<std::vector<int>> until_places, unless_places;  ///< of each step's conditions; -1 where they have none
  std::uint64_t seed = 0;  ///< 0: hands keep their speeds; others vary them by 15 % (one standard deviation) a step
  double hand_speed = 1;   ///< times the script's speeds
};

/// Throws LoadError with the script's line for a place that the vessel does not have.
ScriptPlan make_plan(const Script& script, const SessionModel& model, std::uint64_t seed);

enum class Outcome { running, success, failure, timed_out, aborted };
std::string words_for(Outcome outcome);

struct OperatorState {
  double step = 0;   ///< of the script, as a number
  double began = 1;  ///< 1: the step has yet to begin
  double began_s = 0, began_beats = 0;
  std::vector<double> began_fed_m, began_turned_rad;  ///< one a tool
  std::vector<double> tries;                          ///< one a step of the script
  std::vector<double> felt;  ///< (#tools by 4): push, torque, wall and tip force, behind a low pass of 10 Hz
  double next_s = 0;         ///< when tips are noted next
  std::vector<double> tips;  ///< m, (#tools by noted_tips by 4): of the last 0.25 s, with fed
  double rate_1_min = 0;
  double lao_rad = 0, cran_rad = 0, field_m = 0.2, fluoroscopy = 0, cine = 0;
  Eigen::Vector3d p_PI = Eigen::Vector3d::Zero();
  double iodine_kg_m3 = 350, injection_m3_s = 0;  ///< syringe, thumb
  double began_injected_m3 = 0;
  double gauge_Pa = 0, began_gauge_Pa = 0;                 ///< of the inflation device
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;  ///< to be given in the next step
  double in_the_way = -1;    ///< a tool that ended the script: another could not enter beside it
  double outcome = 0;        ///< an Outcome, as a number
  double by_condition = -1;  ///< which of `unless` held; -1: the timeout
};
inline constexpr int noted_tips = 6;  ///< every 50 ms
inline constexpr double note_every_s = 0.05;

template <class S, class Visit>
void for_each_operator_field(S& state, Visit&& visit) {
  visit("step", &state.step, 1);
  visit("began", &state.began, 1);
  visit("began_s", &state.began_s, 1);
  visit("began_beats", &state.began_beats, 1);
  visit("began_fed_m", state.began_fed_m.data(), static_cast<int>(state.began_fed_m.size()));
  visit("began_turned_rad", state.began_turned_rad.data(), static_cast<int>(state.began_turned_rad.size()));
  visit("tries", state.tries.data(), static_cast<int>(state.tries.size()));
  visit("felt", state.felt.data(), static_cast<int>(state.felt.size()));
  visit("next_s", &state.next_s, 1);
  visit("tips", state.tips.data(), static_cast<int>(state.tips.size()));
  visit("rate_1_min", &state.rate_1_min, 1);
  visit("lao_rad", &state.lao_rad, 1);
  visit("cran_rad", &state.cran_rad, 1);
  visit("field_m", &state.field_m, 1);
  visit("fluoroscopy", &state.fluoroscopy, 1);
  visit("cine", &state.cine, 1);
  visit("isocentre_m", state.p_PI.data(), 3);
  visit("iodine_kg_m3", &state.iodine_kg_m3, 1);
  visit("injection_m3_s", &state.injection_m3_s, 1);
  visit("began_injected_m3", &state.began_injected_m3, 1);
  visit("gauge_Pa", &state.gauge_Pa, 1);
  visit("began_gauge_Pa", &state.began_gauge_Pa, 1);
  visit("heparin_U", &state.heparin_U, 1);
  visit("nitrate_ug", &state.nitrate_ug, 1);
  visit("adenosine_ug", &state.adenosine_ug, 1);
  visit("in_the_way", &state.in_the_way, 1);
  visit("outcome", &state.outcome, 1);
  visit("by_condition", &state.by_condition, 1);
}

OperatorState make_state(const ScriptPlan& plan, const SessionModel& model);
std::vector<double> save(const OperatorState& state);
/// Throws std::invalid_argument if the count is another script's.
void restore(const std::vector<double>& saved, OperatorState& state);

/// What the operator did in deciding.
struct OperatorEvent {
  enum class Kind { begins, done, failed, timed_out, marked } kind = Kind::begins;
  int step = 0;
  int condition = -1;  ///< of until (done) or unless (failed)
};

/// Reads the session as it is after `report`, says what the hands do in the next step. Does not allocate once `events`
/// has grown. `events` is cleared first.
Outcome decide(const ScriptPlan& plan, const SessionModel& model, const SessionState& session,
               const SessionReport& report, OperatorState& state, SessionInputs& inputs,
               std::vector<OperatorEvent>& events);

/// "advance (up the aorta): push_exceeds_N 8"; empty after success.
std::string reason(const ScriptPlan& plan, const OperatorState& state);

/// "guide 3 mm into RCA, wire 25 mm into RV": tips in a patient's body; a step often fails for where another tool lies.
std::string where_tips_lie(const SessionModel& model, const SessionState& session, const SessionReport& report);

}  // namespace ostium
