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

struct BedsideState {
  // Of the balloon that is in the body.
  double balloon = -1;               ///< of TreatmentModel::balloons, as a number
  double branch = -1, middle_m = 0;  ///< its seat (place.h); -1: it is not in one artery
  double held = 0, anchor_m = 0;     ///< 1: the wall holds it, with its middle there, along the path
  double blocked = 0;                ///< 1: a stent that is not open lies in its way
  double drag_N = 0;                 ///< of the wall on what is folded there, distally
  double stent_out = 0;              ///< 1: the stent crimped on it has left the guide, and has not gone back into it
  double caught = 0, caught_N = 0;   ///< 1: drawn back it hangs on the guide's edge, which pushes it distally
  // Of the guide: the catheter that contrast comes through.
  double guide = -1;                            ///< tool, as a number; -1: none is in the body
  double where = 0, cell = 0, into_ostium = 0;  ///< TipPlace of its end hole
  double covered = 0, in_ventricle = 0;         ///< TipPressureInputs
  double filled_m = 0;                          ///< radius of what lies in it
  double thick_wire = 0;                        ///< 1: that is a wire that leaves no room for pressure
  double edge_m = -1e9, edge_N = 0;             ///< StentInputs: its edge on a stent that lies ahead
  double edge_push_N = 0;                       ///< what the guide feels of that
  // Of the others.
  double irritation = 0;                  ///< HeartInputs
  double through_valve = 0;               ///< 1: a wire lies through the aortic valve, or as good as: it cannot close
  double wire_cell = -1, wire_tip_N = 0;  ///< of the flow tree, where a coronary wire's tip is; how hard it presses
  std::vector<double> shaft_m;            ///< (#cells) radius of the widest shaft in each
  double wall_cursor = 0;                 ///< of follow_lumen
};
/// Where the balloon's middle is along its path: where the wall holds it, or where its shaft has it.
inline double seat_m(const BedsideState& s) { return s.held > 0 ? s.anchor_m : s.middle_m; }
BedsideState make_bedside(const Vessel& vessel);

template <class S, class Visit>
void for_each_bedside_field(S& s, Visit&& visit) {
  for (auto& [name, field] : {std::pair{"bedside.balloon", &s.balloon},
                              std::pair{"bedside.branch", &s.branch},
                              std::pair{"bedside.middle_m", &s.middle_m},
                              std::pair{"bedside.held", &s.held},
                              std::pair{"bedside.anchor_m", &s.anchor_m},
                              std::pair{"bedside.drag_N", &s.drag_N},
                              std::pair{"bedside.stent_out", &s.stent_out},
                              std::pair{"bedside.caught", &s.caught},
                              std::pair{"bedside.caught_N", &s.caught_N},
                              std::pair{"bedside.blocked", &s.blocked},
                              std::pair{"bedside.guide", &s.guide},
                              std::pair{"bedside.where", &s.where},
                              std::pair{"bedside.cell", &s.cell},
                              std::pair{"bedside.into_ostium", &s.into_ostium},
                              std::pair{"bedside.covered", &s.covered},
                              std::pair{"bedside.in_ventricle", &s.in_ventricle},
                              std::pair{"bedside.filled_m", &s.filled_m},
                              std::pair{"bedside.thick_wire", &s.thick_wire},
                              std::pair{"bedside.edge_m", &s.edge_m},
                              std::pair{"bedside.edge_N", &s.edge_N},
                              std::pair{"bedside.edge_push_N", &s.edge_push_N},
                              std::pair{"bedside.irritation", &s.irritation},
                              std::pair{"bedside.through_valve", &s.through_valve},
                              std::pair{"bedside.wire_cell", &s.wire_cell},
                              std::pair{"bedside.wire_tip_N", &s.wire_tip_N},
                              std::pair{"bedside.wall_cursor", &s.wall_cursor}})
    visit(name, field, 1);
  visit("bedside.shaft_m", s.shaft_m.data(), static_cast<int>(s.shaft_m.size()));
}

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
