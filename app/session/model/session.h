#pragma once
/// A session: all parts of a simulation, and one step of it.
///
/// Four kinds of memory, as in core. To add a part (contrast, a balloon, signals): its constant part in SessionModel,
/// its inputs in SessionInputs and its state in SessionState, both with a line in the list of fields beside them
/// (core/base/fields.h), and its call in `step`. Recording, replay, hash and comparison follow from the lists.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/coupling/coupling.h"
#include "app/session/vessel/opened_wall.h"
#include "core/step/phases.h"
#include "core/step/step.h"
#include "fluoro/projection/c_arm.h"
#include "vascular/motion/breathing.h"

namespace ostium::app {

/// Const once made; one vessel may be shared by many sessions.
struct SessionModel {
  std::shared_ptr<const Vessel> vessel;
  std::vector<SessionTool> tools;  ///< outermost first; tool i is rod i
  core::Model rods;
  core::EndState entry;                         ///< the introducer
  vascular::PhysiologyModel physiology;         ///< for a mesh, the heart only
  vascular::TreatmentModel treatment;           ///< with the balloons and stents that the tools carry; empty for a mesh
  std::vector<int> balloon_of;                  ///< (#tools) index in treatment.balloons, or -1
  double breaths_1_min = 0;                     ///< of the patient; 0: breath held at expiration
  std::optional<vascular::ArteryBedModel> bed;  ///< of a patient's arteries that give way to instruments
  double step_s() const { return rods.step_s; }
  bool has_patient() const { return vessel->coronaries != nullptr; }
};

struct SessionOptions {
  std::uint64_t seed = 0;          ///< for the person's physiology and for chance
  double breaths_1_min = 0;        ///< of a case's patient, 4 to 60; 0: the breath is held
  bool arteries_yield = false;     ///< a case's coronary arteries give way to what presses on them
  std::optional<double> friction;  ///< of the vessel's wall, overrides vessel_friction; [0, 1]
  std::string begin;  ///< an artery: the introducer is placed before its ostium (entry_ahead_of); empty: at the access
  std::vector<vascular::Drug> drugs;  ///< of the catalogue, that may be given
};

/// Tools are nested where one fits through the other's lumen, balloons over their own wire alone. Two that are not lie
/// side by side in a third one's lumen where there is room (two wires in a guide); what runs over the same wire is
/// exchanged. Throws LoadError naming tools in the wrong order, wires that a balloon does not run over, devices for
/// which a mesh has no arteries, or an artery that is not there.
SessionModel make_session(std::shared_ptr<const Vessel> vessel, std::vector<SessionTool> tools,
                          const SessionOptions& options = {});
/// Why a tool cannot enter.
struct Obstacle {
  int tool = -1;       ///< in the body, that it cannot lie beside; -1: none
  double lacks_m = 0;  ///< width that the lumen around both lacks; 0: it is not a matter of width
};
Obstacle in_the_way(const SessionModel& model, const core::State& rods, int tool);

// --- inputs: the only way to act on a session ------------------------------------------------------------------------

struct ToolInputs {
  double feed_m_s = 0;
  double turn_rad_s = 0;  ///< clockwise as seen from the hub
};
constexpr auto fields(const ToolInputs*) {
  return std::tuple{core::field("advance_m_s", &ToolInputs::feed_m_s),
                    core::field("turn_rad_s", &ToolInputs::turn_rad_s)};
}

struct CArmInputs {
  double lao_rad = 0, cran_rad = 0;
  double field_m = 0.2;
  Eigen::Vector3d p_PI = Eigen::Vector3d::Zero();  ///< isocentre in the patient frame
  bool fluoroscopy = false, cine = false;          ///< pedals pressed
  bool beam() const { return fluoroscopy || cine; }
};
constexpr auto fields(const CArmInputs*) {
  using S = CArmInputs;
  return std::tuple{core::field("lao_rad", &S::lao_rad),         core::field("cran_rad", &S::cran_rad),
                    core::field("field_m", &S::field_m),         core::field("isocentre_m", &S::p_PI),
                    core::field("fluoroscopy", &S::fluoroscopy), core::field("cine", &S::cine)};
}

struct SessionInputs {
  std::vector<ToolInputs> tools;
  CArmInputs c_arm;
  double rate_1_min = 70;  ///< heart rate
  DeliveryInputs delivery;
};
constexpr auto fields(const SessionInputs*) {
  return std::tuple{core::field("tools", &SessionInputs::tools), core::field("c_arm", &SessionInputs::c_arm),
                    core::field("heart_rate_1_min", &SessionInputs::rate_1_min),
                    core::field("bedside", &SessionInputs::delivery)};
}

/// The inputs before anybody acts: hands at rest, the C-arm on the vessel's middle, its heart rate.
SessionInputs inputs_at_rest(const SessionModel& model);

std::size_t input_count(const SessionModel& model);
std::vector<std::string> input_names(const SessionModel& model);  ///< "wire.advance_m_s"
void put_inputs(const SessionInputs& inputs, double* row);
void take_inputs(const double* row, SessionInputs& inputs);

// --- state: all that is needed to continue bit-identically -----------------------------------------------------------

struct HandState {
  double fed_m = 0, turned_rad = 0;      ///< sums of the hand's inputs
  double path_m = 0, turn_path_rad = 0;  ///< sums of their magnitudes
};
constexpr auto fields(const HandState*) {
  return std::tuple{core::field("fed_m", &HandState::fed_m), core::field("turned_rad", &HandState::turned_rad),
                    core::field("path_m", &HandState::path_m), core::field("turn_path_rad", &HandState::turn_path_rad)};
}

struct CArmState {
  double fluoroscopy_s = 0, cine_s = 0;
  int cine_runs = 0;
  bool fluoroscopy = false, cine = false;  ///< pedals in the last step
};
constexpr auto fields(const CArmState*) {
  using S = CArmState;
  return std::tuple{core::field("fluoroscopy_s", &S::fluoroscopy_s), core::field("cine_s", &S::cine_s),
                    core::field("cine_runs", &S::cine_runs), core::field("fluoroscopy", &S::fluoroscopy),
                    core::field("cine", &S::cine)};
}

struct SessionState {
  core::State rods;
  std::vector<HandState> hands;  ///< one per tool
  CArmState c_arm;
  vascular::PhysiologyState blood;  ///< owns the heart's phase; for a mesh, the heart only
  vascular::TreatmentState treatment;
  CouplingState coupling;
  std::vector<double> wall_m;  ///< (#cells) radius of contact's wall (opened_wall.h)
  vascular::BreathState breath;
  vascular::ArteryBedState bed;
  std::vector<Eigen::Vector3d> wall_aside_P;  ///< (#cells) how far contact's wall lies aside; empty without a bed
};
constexpr auto fields(const SessionState*) {
  using S = SessionState;
  return std::tuple{core::field("rods", &S::rods),
                    core::field("hands", &S::hands),
                    core::field("c_arm", &S::c_arm),
                    core::field("blood", &S::blood),
                    core::field("treatment", &S::treatment),
                    core::field("bedside", &S::coupling),
                    core::field("wall_m", &S::wall_m),
                    core::field("breath", &S::breath),
                    core::field("bed", &S::bed),
                    core::field("wall_aside_m", &S::wall_aside_P)};
}

/// The initial state: a circulation in its periodic state. Seed 0: the heart at its R wave, tools as packaged; other
/// seeds draw both at random.
SessionState make_state(const SessionModel& model, std::uint64_t seed);

std::uint64_t hash(const SessionState& state);
std::size_t state_count(const SessionModel& model);
/// `row` has state_count numbers. These functions do not allocate.
void put_state(const SessionState& state, double* row);
void take_state(const double* row, SessionState& state);
/// "rod 0 (wire), velocity[12]: 0.1 != 0.2", "hands[0].fed_m: 0.1 != 0.2", or empty if they are bit-identical.
std::string first_difference(const SessionModel& model, const SessionState& a, const SessionState& b);

// --- a step ----------------------------------------------------------------------------------------------------------

/// The phases of a session's step that a clock tells apart, after those of core (core/step/phases.h).
enum SessionPhase {
  moving_heart = core::step_phases,  ///< heart, breath, hands, the wall's shape
  looking,                           ///< where instruments lie
  treating,                          ///< balloon, stent, plaque
  moving_blood,                      ///< flow, contrast
  hashing,                           ///< of the state, by whoever asks for it
  session_phases
};
const char* phase_name(int phase);  ///< of core or of a session

/// A wall that treatment opens is the session's own: a copy of the vessel's surface, which takes 0.2 s and 100 MB. Made
/// at once, no step waits for it; made when the wall first changes, sessions that only navigate share the vessel's.
enum class WallCopy { at_once, when_it_opens };

struct SessionScratch {
  explicit SessionScratch(const SessionModel& model, WallCopy copy = WallCopy::at_once);
  SessionScratch(const SessionScratch&) = delete;
  core::Model now;  ///< model.rods, with the current wall
  core::Scratch rods;
  core::Inputs inputs;  ///< of core
  /// Counts the time of the phases of a step, for a profile; null: nobody does.
  void count_time(core::PhaseClock* clock) { rods.clock = clock; }
  // For a patient.
  std::optional<OpenedWall> wall;  ///< none: that of the vessel
  /// The wall of this state, which is a copy from the first change on.
  void set_wall(const SessionModel& model, const std::vector<double>& wall_m,
                const std::vector<Eigen::Vector3d>& wall_aside_P);
  std::optional<CouplingScratch> coupling;
  vascular::PhysiologyInputs physiology_inputs;
  vascular::PhysiologyScratch physiology;
  vascular::TreatmentScratch treatment;

 private:
  void own_the_wall(const SessionModel& model);
};

/// Forces on a tool that an operator could measure.
struct ToolReport {
  double push_N = 0, torque_Nm = 0;          ///< at the hand
  double wall_force_N = 0, tip_force_N = 0;  ///< sum of the walls' normal forces; the same on its last 10 mm
  int touches = 0;
  bool in_body = false;
};

struct SessionReport {
  core::StepReport rods;
  std::vector<ToolReport> tools;  ///< sized at the first step
  vascular::TreatmentReport treatment;
  vascular::ContrastReport contrast;  ///< from the last circulation step
  int refused = -1;                   ///< a tool that was fed but may not enter, because
  int in_its_way = -1;                ///< this tool is in the body
};

/// Advances `state` by model.step_s(). Never throws; does not allocate after the first call with the same report.
void step(const SessionModel& model, const SessionInputs& inputs, SessionState& state, SessionScratch& scratch,
          SessionReport& report);

double seconds(const SessionModel& model, const SessionState& state);
/// Position of its distal end, m, and its direction; the introducer's while it is outside the body.
Eigen::Vector3d tip(const SessionModel& model, const SessionState& state, int tool);
Eigen::Vector3d tip_direction(const SessionModel& model, const SessionState& state, int tool);
/// Waist of a balloon between its markers: smallest over largest diameter.
double waist(const vascular::BalloonModel& model, const vascular::BalloonState& state);

/// Depth of the patient's breath at the end of a step (0: expiration, 1: full inspiration).
double breath(const SessionModel& model, const SessionState& state);

/// How the heart's vessels lie at the end of a step.
inline vascular::LumenMoment moment(const SessionModel& model, const SessionState& state) {
  return {state.blood.heart.phase, breath(model, state), state.wall_aside_P};
}

}  // namespace ostium::app
