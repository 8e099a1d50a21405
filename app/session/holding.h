#pragma once
/// What the wall and other devices do to a tool's rod: the wall round an open balloon holds its shaft like a spring
/// that slides where friction bears no more; a guide's edge pushes a stent that hangs on it, and a stent the guide.
#include "app/session/bedside.h"

namespace ostium {

/// When in the heart's and the breath's cycles.
struct Moment {
  double phase = 0, breath = 0;
};

/// Whether the wall holds the balloon, and where along its artery: after a step, by what the wall pressed it with and
/// where its shaft has it. Beyond what friction bears it is dragged along.
void hold_balloon(const BedsideModel& model, const State& rods, const BalloonReport& report, Moment moment,
                  BedsideState& state);

/// The wall on the balloon's shaft in the step that ends at `moment`: its middle is held along the artery.
Tether tether_on_shaft(const BedsideModel& model, const TreatmentState& treatment, const BedsideState& state, int tool,
                       Moment moment);

/// On the balloon's shaft, between its markers: the guide's edge that its stent hangs on. On the guide's tip: the stent
/// that it pushes.
StretchLoad load_on_shaft(const BedsideModel& model, const State& rods, const BedsideState& state, int tool);

}  // namespace ostium
