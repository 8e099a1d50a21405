#pragma once
/// What instruments are to the coronary arteries, and these to them: where balloons, tips and shafts lie, what holds a
/// balloon, what reaches guide, muscle and valve.
///
/// Rods know no balloon and balloons no rod. Every `look_every` steps the rods are looked at, and what matters of them
/// is kept in BedsideState: from there come TreatmentInputs and PhysiologyInputs of every step. What the wall and other
/// devices do to a tool's rod in turn: holding.h.
#include "app/session/vessel.h"
#include "core/step.h"
#include "data/catalogue/instrument/instrument.h"
#include "vascular/place.h"

namespace ostium {

struct SessionTool {
  std::string name;  ///< what a script calls it
  Instrument instrument;
};

inline constexpr int look_every = 8;  ///< steps: as often as blood and contrast move (circulation_step_s)

/// What a hand asks of the circulation; all are recorded inputs.
struct BedsideInputs {
  double injection_m3_s = 0;  ///< by the thumb, into the guide's line
  double iodine_kg_m3 = 350;  ///< of what is in the syringe; 0: saline
  double gauge_Pa = 0;        ///< of the inflation device, on the balloon that is in the body; below 0: vacuum
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;  ///< given in this step
};
constexpr auto fields(const BedsideInputs*) {
  using S = BedsideInputs;
  return std::tuple{field("injection_m3_s", &S::injection_m3_s),
                    field("iodine_kg_m3", &S::iodine_kg_m3),
                    field("gauge_Pa", &S::gauge_Pa),
                    field("heparin_U", &S::heparin_U),
                    field("nitrate_ug", &S::nitrate_ug),
                    field("adenosine_ug", &S::adenosine_ug)};
}

struct BedsideState {
  // Of the balloon that is in the body.
  int balloon = -1;        ///< of TreatmentModel::balloons; -1: none is
  int branch = -1;         ///< its seat (place.h); -1: it is not in one artery
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
  TipPlace tip;                      ///< of its end hole
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
constexpr auto fields(const BedsideState*) {
  using S = BedsideState;
  return std::tuple{field("balloon", &S::balloon),
                    field("branch", &S::branch),
                    field("middle_m", &S::middle_m),
                    field("held", &S::held),
                    field("anchor_m", &S::anchor_m),
                    field("blocked", &S::blocked),
                    field("drag_N", &S::drag_N),
                    field("stent_out", &S::stent_out),
                    field("caught", &S::caught),
                    field("caught_N", &S::caught_N),
                    field("guide", &S::guide),
                    field("tip", &S::tip),
                    field("covered", &S::covered),
                    field("in_ventricle", &S::in_ventricle),
                    field("filled_m", &S::filled_m),
                    field("thick_wire", &S::thick_wire),
                    field("edge_m", &S::edge_m),
                    field("edge_N", &S::edge_N),
                    field("edge_push_N", &S::edge_push_N),
                    field("irritation", &S::irritation),
                    field("through_valve", &S::through_valve),
                    field("wire_cell", &S::wire_cell),
                    field("wire_tip_N", &S::wire_tip_N),
                    field("shaft_m", &S::shaft_m),
                    field("wall_cursor", &S::wall_cursor)};
}
/// Where the balloon's middle is along its path: where the wall holds it, or where its shaft has it.
inline double seat_m(const BedsideState& s) { return s.held ? s.anchor_m : s.middle_m; }
BedsideState make_bedside(const Vessel& vessel);

/// The balloons and stents that tools carry, added to `model`; of each tool its balloon, or -1. Throws LoadError for
/// sizes that vascular refuses.
std::vector<int> add_devices(const std::vector<SessionTool>& tools, std::uint64_t seed, TreatmentModel& model);

/// Whether a balloon's folds are together again.
bool is_empty(const BalloonModel& model, const BalloonState& state);

/// Everything of a session that is const, as this part needs it.
struct BedsideModel {
  const Vessel& vessel;
  const std::vector<SessionTool>& tools;
  const Model& rods;
  const PhysiologyModel& physiology;
  const TreatmentModel& treatment;
  const std::vector<int>& balloon_of;  ///< (#tools)
};

struct BedsideScratch {
  explicit BedsideScratch(const Vessel& vessel);
  CellLocator locator;
  std::vector<Eigen::Vector3d> points;
};

/// Looks at the rods as they are after a step, at a phase of the heart and a depth of breath.
void look(const BedsideModel& model, const State& rods, const TreatmentState& treatment, const StepReport& report,
          double phase, double breath, BedsideScratch& scratch, BedsideState& state);

/// How hard a coronary wire's tip presses the wall, behind the low pass of all wall forces: what lasts a millisecond
/// makes no hole. At each step.
void press_with_wire(const BedsideModel& model, const StepReport& report, double step_s, BedsideState& state);
TreatmentInputs treatment_inputs(const BedsideInputs& inputs, const BedsideState& state);
/// Contrast and pressure; the heart's and what is occupied are the caller's.
void set_physiology_inputs(const BedsideModel& model, const BedsideInputs& inputs, const BedsideState& state,
                           PhysiologyInputs& to);

/// What contrast runs through to a guide's tip.
Line line_of(const Instrument& guide);

/// Of a rod's last two elements.
Eigen::Vector3d direction_at_tip(const Rod& rod, const RodState& state);
/// The distance of a marker's middle from the tip, m; 0 proximal, 1 distal.
double marker_from_tip_m(const Instrument& instrument, int which);
/// A point of a rod that is so far from its tip, m; the introducer if that is outside.
Eigen::Vector3d point_from_tip(const Rod& rod, const RodState& state, double from_tip_m);

}  // namespace ostium
