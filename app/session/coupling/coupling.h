#pragma once
/// Instrument-vessel coupling: where balloons, tips and shafts lie in the coronary arteries, what holds a balloon, and
/// how instruments affect guide pressure, muscle and valve.
///
/// Rods and balloons do not know of each other. Every `look_every` steps the rods are evaluated and the result is
/// stored in CouplingState, from which TreatmentInputs and PhysiologyInputs of every step are derived. For the forces
/// of the wall and other devices on a tool's rod see device_constraints.h.
#include "app/session/vessel/vessel.h"
#include "core/step/step.h"
#include "data/catalogue/instrument/instrument.h"
#include "vascular/contrast/cell_locator.h"
#include "vascular/treatment/artery_bed.h"

namespace ostium::app {

struct SessionTool {
  std::string name;  ///< its name in a script
  data::Instrument instrument;
  std::string over;  ///< of several wires that go through it, the one that it runs over; empty: there is one
};

inline constexpr double undiluted_kg_m3 = 350;        ///< iodine in the syringe unless something else is said
inline constexpr double visible_kg_m3 = 60;           ///< of iodine in an artery, from which on contrast is seen there
inline constexpr double visible_leak_m3_s = 0.02e-6;  ///< out of an artery, that a film shows
inline constexpr int look_every = 8;  ///< steps; as often as blood and contrast are updated (circulation_step_s)

/// What the operator gives: contrast, pressure and drugs. All are recorded inputs.
struct DeliveryInputs {
  double injection_m3_s = 0;   ///< from the syringe into the guide's line
  double iodine_kg_m3 = 350;   ///< of the syringe's contents; 0: saline
  double aspiration_m3_s = 0;  ///< into the syringe, while nothing is injected
  double gauge_Pa = 0;  ///< of the inflation device, on the balloon that came into the body first; below 0: vacuum
  double second_gauge_Pa = 0;  ///< of a second one, on the other balloon in the body, if there is one
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;  ///< given in this step
  int drug = -1;                  ///< of the catalogue (vascular::DrugModel::others), given in this step; -1: none
  double drug_dose = 0;           ///< of that, in its unit
  double infusion_m3_s = 0;       ///< of fluid, into a vein
  double drain_m3_s = 0;          ///< out of the pericardium, through a drain
  double shock_J = 0;             ///< of a defibrillator, in this step
  double compressions_1_min = 0;  ///< of the chest
  double pacing_1_min = 0, pacing_mA = 0;  ///< of a temporary pacemaker, by a wire in the right ventricle
  int breath_asked = 0;                    ///< vascular::BreathAsked: 0 breathe, 1 in and hold, 2 out and hold
  // What a trainer provokes, in this step (vascular::Provocation):
  int provoked = 0, provoked_cell = -1;
  double provoked_size = 0;
};
constexpr auto fields(const DeliveryInputs*) {
  using S = DeliveryInputs;
  return std::tuple{core::field("injection_m3_s", &S::injection_m3_s),
                    core::field("iodine_kg_m3", &S::iodine_kg_m3),
                    core::field("aspiration_m3_s", &S::aspiration_m3_s),
                    core::field("gauge_Pa", &S::gauge_Pa),
                    core::field("second_gauge_Pa", &S::second_gauge_Pa),
                    core::field("heparin_U", &S::heparin_U),
                    core::field("nitrate_ug", &S::nitrate_ug),
                    core::field("adenosine_ug", &S::adenosine_ug),
                    core::field("drug", &S::drug),
                    core::field("drug_dose", &S::drug_dose),
                    core::field("infusion_m3_s", &S::infusion_m3_s),
                    core::field("drain_m3_s", &S::drain_m3_s),
                    core::field("shock_J", &S::shock_J),
                    core::field("compressions_1_min", &S::compressions_1_min),
                    core::field("pacing_1_min", &S::pacing_1_min),
                    core::field("pacing_mA", &S::pacing_mA),
                    core::field("breath_asked", &S::breath_asked),
                    core::field("provoked", &S::provoked),
                    core::field("provoked_cell", &S::provoked_cell),
                    core::field("provoked_size", &S::provoked_size)};
}
/// What is given in one step and not in the next: doses, a shock, a provocation.
void forget_what_is_given_once(DeliveryInputs& inputs);

/// A balloon in the body.
struct CoupledBalloon {
  int tool = -1;                                   ///< that carries it; -1: there is none
  int balloon = -1;                                ///< of TreatmentModel::balloons; -1: none is
  int branch = -1;                                 ///< its seat (cell_locator.h); -1: not in a single artery
  double middle_m = 0;                             ///< of its markers along the path, by its shaft
  std::vector<Eigen::Vector2d> aside_m, bend_1_m;  ///< vascular::ShaftPlace (balloon_spheres)
  bool blocked = false;                            ///< an unexpanded stent blocks its way
  double drag_N = 0;                               ///< of the wall on the folded device, distally
  bool stent_out = false;                          ///< its crimped stent has left the guide and has not re-entered it
  bool caught = false;  ///< while being drawn back, the stent hangs on the guide's edge, which pushes it distally with
  double caught_N = 0;
};
constexpr auto fields(const CoupledBalloon*) {
  using S = CoupledBalloon;
  return std::tuple{core::field("tool", &S::tool),           core::field("balloon", &S::balloon),
                    core::field("branch", &S::branch),       core::field("middle_m", &S::middle_m),
                    core::field("aside_m", &S::aside_m),     core::field("bend_1_m", &S::bend_1_m),
                    core::field("blocked", &S::blocked),     core::field("drag_N", &S::drag_N),
                    core::field("stent_out", &S::stent_out), core::field("caught", &S::caught),
                    core::field("caught_N", &S::caught_N)};
}

struct CouplingState {
  /// A balloon that enters takes the first place that is free, and keeps it until it is out.
  std::array<CoupledBalloon, vascular::most_balloons> balloons;
  int first = 0;  ///< place of the balloon that came first
  // The guide: the catheter that contrast is injected through.
  int guide = -1;                    ///< tool; -1: none in the body
  vascular::TipPlace tip;            ///< position of its end hole
  double covered = 0;                ///< input of TipPressureInputs
  bool in_ventricle = false;         ///< input of TipPressureInputs
  double filled_m = 0;               ///< radius of the instrument inside it
  bool thick_wire = false;           ///< that is a wire so thick that no pressure is transmitted
  double edge_m = -1e9, edge_N = 0;  ///< StentInputs: its edge, and the force on a stent ahead
  double edge_push_N = 0;            ///< reaction of that on the guide
  // The other tools:
  double irritation = 0;        ///< input of HeartInputs
  bool through_valve = false;   ///< a wire lies in or close to the aortic valve, which cannot close
  int wire_cell = -1;           ///< cell of the flow tree at a coronary wire's tip; -1: none
  double wire_tip_N = 0;        ///< force that it presses with
  std::vector<double> shaft_m;  ///< (#cells) radius of the thickest shaft in each
  int wall_cursor = 0;          ///< cursor of follow_lumen
};
constexpr auto fields(const CouplingState*) {
  using S = CouplingState;
  return std::tuple{core::field("balloons", &S::balloons),
                    core::field("first", &S::first),
                    core::field("guide", &S::guide),
                    core::field("tip", &S::tip),
                    core::field("covered", &S::covered),
                    core::field("in_ventricle", &S::in_ventricle),
                    core::field("filled_m", &S::filled_m),
                    core::field("thick_wire", &S::thick_wire),
                    core::field("edge_m", &S::edge_m),
                    core::field("edge_N", &S::edge_N),
                    core::field("edge_push_N", &S::edge_push_N),
                    core::field("irritation", &S::irritation),
                    core::field("through_valve", &S::through_valve),
                    core::field("wire_cell", &S::wire_cell),
                    core::field("wire_tip_N", &S::wire_tip_N),
                    core::field("shaft_m", &S::shaft_m),
                    core::field("wall_cursor", &S::wall_cursor)};
}
CouplingState make_coupling(const Vessel& vessel);

/// Adds the balloons and stents that tools carry to `model`. Returns each tool's balloon, or -1. Throws LoadError for
/// sizes that vascular refuses.
std::vector<int> add_devices(const std::vector<SessionTool>& tools, std::uint64_t seed,
                             vascular::TreatmentModel& model);

/// A balloon in the body, with what treatment keeps of it; null: there is none.
struct BalloonInBody {
  const CoupledBalloon* place = nullptr;
  const vascular::BalloonState* state = nullptr;
  double gauge_Pa = 0;  ///< of its inflation device
  explicit operator bool() const { return place != nullptr; }
};
/// `nth`: 0 the one that came into the body first and is still there, 1 the other.
BalloonInBody balloon_in_body(const CouplingState& state, const vascular::TreatmentState& treatment,
                              const DeliveryInputs& inputs, int nth);
/// The place of a tool's balloon; -1: it is not in the body.
int place_of(const CouplingState& state, int tool);

/// The constant parts of a session that coupling needs.
struct CouplingModel {
  const Vessel& vessel;
  const std::vector<SessionTool>& tools;
  const core::Model& rods;
  const vascular::PhysiologyModel& physiology;
  const vascular::TreatmentModel& treatment;
  const std::vector<int>& balloon_of;  ///< (#tools)
};

struct CouplingScratch {
  explicit CouplingScratch(const Vessel& vessel);
  vascular::CellLocator locator;
  std::vector<Eigen::Vector3d> points;
  // Of arteries that give way (artery_loads.h):
  std::vector<Eigen::Vector3d> load_P_N;  ///< (#cells)
  std::vector<vascular::BedTube> tubes;
  vascular::ArteryBedScratch bed;
};

/// Updates the coupling from the rods after a step.
void look(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
          const core::StepReport& report, const vascular::LumenMoment& moment, CouplingScratch& scratch,
          CouplingState& state);

/// The force of a coronary wire's tip on the wall, low-pass filtered like all wall forces: a millisecond's peak does
/// not perforate. Call at every step.
void press_with_wire(const CouplingModel& model, const core::StepReport& report, double step_s, CouplingState& state);
/// What is drawn out of the guide, and so out of the body, m3/s: its lumen and what lies in it decide.
double drawn_m3_s(const CouplingModel& model, const DeliveryInputs& inputs, const CouplingState& state);
/// `moment`: at which rods and wall are now.
vascular::TreatmentInputs treatment_inputs(const CouplingModel& model, const core::State& rods,
                                           const vascular::TreatmentState& treatment, const DeliveryInputs& inputs,
                                           const vascular::LumenMoment& moment, const CouplingState& state);
/// Sets contrast and pressure; the caller sets the heart's inputs and the occupied cross-sections.
void set_physiology_inputs(const CouplingModel& model, const DeliveryInputs& inputs, const CouplingState& state,
                           vascular::PhysiologyInputs& to);

/// The line through which contrast reaches a guide's tip.
vascular::Line line_of(const data::Instrument& guide);

}  // namespace ostium::app
