#pragma once
/// What instruments are to the coronary arteries, and these to them: where balloons, tips and shafts lie, what holds a
/// balloon, what reaches guide, muscle and valve.
///
/// Rods know no balloon and balloons no rod. Every `look_every` steps the rods are looked at, and what matters of them
/// is kept in CouplingState: from there come TreatmentInputs and PhysiologyInputs of every step. What the wall and
/// other devices do to a tool's rod in turn: device_constraints.h.
#include "app/session/vessel/vessel.h"
#include "core/step/step.h"
#include "data/catalogue/instrument/instrument.h"
#include "vascular/contrast/cell_locator.h"

namespace ostium::app {

struct SessionTool {
  std::string name;  ///< what a script calls it
  data::Instrument instrument;
};

inline constexpr int look_every = 8;  ///< steps: as often as blood and contrast move (circulation_step_s)

/// What a hand asks of the circulation; all are recorded inputs.
struct DeliveryInputs {
  double injection_m3_s = 0;  ///< by the thumb, into the guide's line
  double iodine_kg_m3 = 350;  ///< of what is in the syringe; 0: saline
  double gauge_Pa = 0;        ///< of the inflation device, on the balloon that is in the body; below 0: vacuum
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;  ///< given in this step
};
constexpr auto fields(const DeliveryInputs*) {
  using S = DeliveryInputs;
  return std::tuple{core::field("injection_m3_s", &S::injection_m3_s),
                    core::field("iodine_kg_m3", &S::iodine_kg_m3),
                    core::field("gauge_Pa", &S::gauge_Pa),
                    core::field("heparin_U", &S::heparin_U),
                    core::field("nitrate_ug", &S::nitrate_ug),
                    core::field("adenosine_ug", &S::adenosine_ug)};
}

struct CouplingState {
  // Of the balloon that is in the body.
  int balloon = -1;        ///< of TreatmentModel::balloons; -1: none is
  int branch = -1;         ///< its seat (cell_locator.h); -1: it is not in one artery
  double middle_m = 0;     ///< along the path
  bool held = false;       ///< the wall holds it, with its middle at
  double anchor_m = 0;     ///< along the path
  bool blocked = false;    ///< a stent that is not open lies in its way
  double drag_N = 0;       ///< of the wall on what is folded there, distally
  bool stent_out = false;  ///< the stent crimped on it has left the guide, and has not gone back into it
  bool caught = false;     ///< drawn back it hangs on the guide's edge, which pushes it distally with
  double caught_N = 0;
  // Of the guide: the catheter that contrast comes through.
  int guide = -1;                    ///< tool; -1: none is in the body
  vascular::TipPlace tip;            ///< of its end hole
  double covered = 0;                ///< TipPressureInputs
  bool in_ventricle = false;         ///< TipPressureInputs
  double filled_m = 0;               ///< radius of what lies in it
  bool thick_wire = false;           ///< that is a wire that leaves no room for pressure
  double edge_m = -1e9, edge_N = 0;  ///< StentInputs: its edge on a stent that lies ahead
  double edge_push_N = 0;            ///< what the guide feels of that
  // Of the others.
  double irritation = 0;        ///< HeartInputs
  bool through_valve = false;   ///< a wire lies through the aortic valve, or as good as: it cannot close
  int wire_cell = -1;           ///< of the flow tree, where a coronary wire's tip is; -1: nowhere
  double wire_tip_N = 0;        ///< how hard it presses
  std::vector<double> shaft_m;  ///< (#cells) radius of the widest shaft in each
  int wall_cursor = 0;          ///< of follow_lumen
};
constexpr auto fields(const CouplingState*) {
  using S = CouplingState;
  return std::tuple{core::field("balloon", &S::balloon),
                    core::field("branch", &S::branch),
                    core::field("middle_m", &S::middle_m),
                    core::field("held", &S::held),
                    core::field("anchor_m", &S::anchor_m),
                    core::field("blocked", &S::blocked),
                    core::field("drag_N", &S::drag_N),
                    core::field("stent_out", &S::stent_out),
                    core::field("caught", &S::caught),
                    core::field("caught_N", &S::caught_N),
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
/// Where the balloon's middle is along its path: where the wall holds it, or where its shaft has it.
inline double seat_m(const CouplingState& s) { return s.held ? s.anchor_m : s.middle_m; }
CouplingState make_coupling(const Vessel& vessel);

/// The balloons and stents that tools carry, added to `model`; of each tool its balloon, or -1. Throws LoadError for
/// sizes that vascular refuses.
std::vector<int> add_devices(const std::vector<SessionTool>& tools, std::uint64_t seed,
                             vascular::TreatmentModel& model);

/// Whether a balloon's folds are together again.
bool is_empty(const vascular::BalloonModel& model, const vascular::BalloonState& state);

/// Everything of a session that is const, as this part needs it.
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
};

/// Looks at the rods as they are after a step, at a phase of the heart and a depth of breath.
void look(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
          const core::StepReport& report, double phase, double breath, CouplingScratch& scratch, CouplingState& state);

/// How hard a coronary wire's tip presses the wall, behind the low pass of all wall forces: what lasts a millisecond
/// makes no hole. At each step.
void press_with_wire(const CouplingModel& model, const core::StepReport& report, double step_s, CouplingState& state);
vascular::TreatmentInputs treatment_inputs(const DeliveryInputs& inputs, const CouplingState& state);
/// Contrast and pressure; the heart's and what is occupied are the caller's.
void set_physiology_inputs(const CouplingModel& model, const DeliveryInputs& inputs, const CouplingState& state,
                           vascular::PhysiologyInputs& to);

/// What contrast runs through to a guide's tip.
vascular::Line line_of(const data::Instrument& guide);

}  // namespace ostium::app
