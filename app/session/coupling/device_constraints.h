#pragma once
/// What the wall and other devices do to a tool's rod: the wall round an open balloon holds its shaft like a spring
/// that slides where friction bears no more; a guide's edge pushes a stent that hangs on it, and a stent the guide.
#include "app/session/coupling/coupling.h"

namespace ostium::app {

/// When in the heart's and the breath's cycles.
struct Moment {
  double phase = 0, breath = 0;
};

/// Whether the wall holds the balloon, and where along its artery: after a step, by what the wall pressed it with and
/// where its shaft has it. Beyond what friction bears it is dragged along.
void hold_balloon(const CouplingModel& model, const core::State& rods, const vascular::BalloonReport& report,
                  Moment moment, CouplingState& state);

/// The wall on the balloon's shaft in the step that ends at `moment`: its middle is held along the artery.
core::Tether tether_on_shaft(const CouplingModel& model, const vascular::TreatmentState& treatment,
                             const CouplingState& state, int tool, Moment moment);

/// On the balloon's shaft, between its markers: the guide's edge that its stent hangs on. On the guide's tip: the stent
/// that it pushes.
core::StretchLoad load_on_shaft(const CouplingModel& model, const core::State& rods, const CouplingState& state,
                                int tool);

}  // namespace ostium::app
