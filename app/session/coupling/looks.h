#pragma once
/// The parts of look() (coupling.h), in its order: each looks at the rods after a step and keeps in CouplingState what
/// it finds. Positions are in the world; `root_shift` is how far the aortic root has moved from its place at
/// end-diastole, breathed out, m.
#include "app/session/coupling/coupling.h"

namespace ostium::app {

inline constexpr double near_heart_m = 6e-3;     ///< of the box about all cells
inline constexpr double thick_wire_m = 0.35e-3;  ///< radius; 0.035 in wires are thicker
inline constexpr double edge_N_m = 500;          ///< of a guide's edge against a stent [estimate]
inline constexpr double most_caught_N = 5;       ///< a balloon's shaft tears soon beyond [estimate]

/// A coronary wire.
inline bool is_thin_wire(const data::Instrument& i) {
  return i.kind == data::InstrumentKind::wire && i.outer_diameter_m < 2 * thick_wire_m;
}

// shafts_look.cpp: how wide the widest shaft in each cell is; where wires lie.
void look_at_shafts(const CouplingModel& model, const core::State& rods, CouplingScratch& x, CouplingState& s);
void look_at_wires(const CouplingModel& model, const core::State& rods, const core::StepReport& report,
                   const Eigen::Vector3d& root_shift, CouplingScratch& x, CouplingState& s);
/// Force of the walls on a tool's last 3 mm, N.
double tip_force_N(const CouplingModel& model, const core::StepReport& report, int tool);
/// The artery's cell at a tool's tip; -1: outside of them, or of the body.
int cell_at_tip(const CouplingModel& model, const core::State& rods, int tool, const CouplingScratch& x);

// balloon_look.cpp: where the balloons sit, what their crimped stents hang on.
void look_at_balloons(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
                      const core::StepReport& report, const vascular::LumenMoment& moment, CouplingScratch& x,
                      CouplingState& s);
/// A crimped stent that is drawn back into the guide hangs on its edge if the shaft leaves the guide at an angle, or if
/// it is no longer crimped. The edge holds it; what it cannot be pulled off its balloon with, the shaft feels.
void look_at_crimped_stents(const CouplingModel& model, const core::State& rods,
                            const vascular::TreatmentState& treatment, CouplingState& s);

// guide_look.cpp: where the guide's tip is, what it pushes.
void look_at_guide(const CouplingModel& model, const core::State& rods, const core::StepReport& report,
                   const vascular::LumenMoment& moment, const Eigen::Vector3d& root_shift, CouplingScratch& x,
                   CouplingState& s);
/// A guide that goes so deep that it meets a stent in the wall pushes its end, if it does not lie in the middle of it.
void look_at_edge(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
                  CouplingScratch& x, CouplingState& s);

// valve_look.cpp: what lies through the aortic valve, and irritates the ventricle.
void look_at_valve(const CouplingModel& model, const core::State& rods, const core::StepReport& report,
                   const vascular::LumenMoment& moment, const Eigen::Vector3d& root_shift, CouplingState& s);

}  // namespace ostium::app
