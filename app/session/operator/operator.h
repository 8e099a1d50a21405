#pragma once
/// The operator of a script: observes the session and moves the instruments. Its whole memory is OperatorState; its
/// output is SessionInputs, as for any driver.
#include <string>
#include <vector>

#include "app/session/model/session.h"
#include "data/catalogue/script/script.h"

namespace ostium::app {

/// A script with its places resolved in a vessel.
struct ScriptPlan {
  data::Script script;
  std::vector<std::vector<int>> until_places, unless_places;  ///< of each step's conditions; -1 if they have none
  std::vector<int> subjects;  ///< of each step: the flow cell of its `at`, the index of the drug that it gives; -1
  std::uint64_t seed = 0;     ///< 0: exact speeds; otherwise they vary from step to step, standard deviation 15 %
  double hand_speed = 1;      ///< factor on the script's speeds
};

/// Throws LoadError with the script's line for a place that the vessel does not have.
ScriptPlan make_plan(const data::Script& script, const SessionModel& model, std::uint64_t seed);

/// `ended`: by the person who moved the instruments, whose run has no step that must be done.
enum class Outcome { running, success, failure, timed_out, aborted, ended };
std::string words_for(Outcome outcome);

struct OperatorState {
  int step = 0;       ///< index in the script
  bool began = true;  ///< the step has yet to begin
  double began_s = 0, began_beats = 0;
  std::vector<double> began_fed_m, began_turned_rad;  ///< one per tool
  std::vector<int> tries;                             ///< one per step of the script
  std::vector<double> felt;  ///< (#tools by 4): push, torque, wall and tip force, low-pass filtered at 10 Hz
  double next_s = 0;         ///< when tips are noted next
  std::vector<double> tips;  ///< (#tools by noted_tips by 4): tip position and fed length over the last 0.25 s, m
  double rate_1_min = 0;
  double lao_rad = 0, cran_rad = 0, field_m = 0.2;
  bool fluoroscopy = false, cine = false;
  Eigen::Vector3d p_PI = Eigen::Vector3d::Zero();
  double iodine_kg_m3 = 350, injection_m3_s = 0;                             ///< of the syringe
  std::array<double, vascular::most_balloons> gauge_Pa{}, began_gauge_Pa{};  ///< of the inflation devices
  DeliveryInputs given;       ///< to be given in the next step: doses, fluid, drain, what the heart needs
  double began_moved_m3 = 0;  ///< by the line or drain that the step uses, until it began
  int in_the_way = -1;        ///< the tool that ended the script: another could not enter beside it
  Outcome outcome = Outcome::running;
  int by_condition = -1;  ///< index of the `unless` condition that held; -1: the timeout
};
constexpr auto fields(const OperatorState*) {
  using S = OperatorState;
  return std::tuple{core::field("step", &S::step),
                    core::field("began", &S::began),
                    core::field("began_s", &S::began_s),
                    core::field("began_beats", &S::began_beats),
                    core::field("began_fed_m", &S::began_fed_m),
                    core::field("began_turned_rad", &S::began_turned_rad),
                    core::field("tries", &S::tries),
                    core::field("felt", &S::felt),
                    core::field("next_s", &S::next_s),
                    core::field("tips", &S::tips),
                    core::field("rate_1_min", &S::rate_1_min),
                    core::field("lao_rad", &S::lao_rad),
                    core::field("cran_rad", &S::cran_rad),
                    core::field("field_m", &S::field_m),
                    core::field("fluoroscopy", &S::fluoroscopy),
                    core::field("cine", &S::cine),
                    core::field("isocentre_m", &S::p_PI),
                    core::field("iodine_kg_m3", &S::iodine_kg_m3),
                    core::field("injection_m3_s", &S::injection_m3_s),
                    core::field("gauge_Pa", &S::gauge_Pa),
                    core::field("began_gauge_Pa", &S::began_gauge_Pa),
                    core::field("given", &S::given),
                    core::field("began_moved_m3", &S::began_moved_m3),
                    core::field("in_the_way", &S::in_the_way),
                    core::field("outcome", &S::outcome),
                    core::field("by_condition", &S::by_condition)};
}
inline constexpr int noted_tips = 6;  ///< one every 50 ms
inline constexpr double note_every_s = 0.05;

OperatorState make_state(const ScriptPlan& plan, const SessionModel& model);
std::vector<double> save(const OperatorState& state);
/// Throws std::invalid_argument if the number of values does not match the script.
void restore(const std::vector<double>& saved, OperatorState& state);

/// An event of the operator's decisions, or of a lesson beside them.
struct OperatorEvent {
  enum class Kind { begins, done, failed, timed_out, marked, instructed, hinted } kind = Kind::begins;
  int step = 0;        ///< of the script; of the last two kinds the lesson's instruction
  int condition = -1;  ///< index in `until` (done) or `unless` (failed)
};

/// Evaluates the session after `report`, and sets the inputs of the next step. Does not allocate once `events` has
/// grown. `events` is cleared first.
Outcome decide(const ScriptPlan& plan, const SessionModel& model, const SessionState& session,
               const SessionReport& report, OperatorState& state, SessionInputs& inputs,
               std::vector<OperatorEvent>& events);

/// "advance (up the aorta): push_exceeds_N 8", "...: timed out after 5 s, waiting for fed_mm 30 (now 12.3)"; empty
/// after success. The session as it was judged last.
std::string reason(const ScriptPlan& plan, const SessionModel& model, const SessionState& session,
                   const SessionReport& report, const OperatorState& state);

/// "guide 3 mm into RCA, wire 25 mm into RV": tips in a patient's body; a step often fails because of where another
/// tool lies.
std::string where_tips_lie(const SessionModel& model, const SessionState& session, const SessionReport& report);

}  // namespace ostium::app
