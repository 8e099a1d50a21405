#pragma once
/// Forces of the wall and other devices on a tool's rod: the wall around an open balloon holds its shaft like a spring
/// that slides at the friction limit; a guide's edge pushes a stent caught on it, and that stent pushes the guide.
#include "app/session/coupling/coupling.h"

namespace ostium::app {

/// Updates after a step whether the wall holds the balloon, and where along its artery, from the wall's pressure and
/// the shaft's position. Beyond the friction limit the balloon is dragged along.
void hold_balloon(const CouplingModel& model, const core::State& rods, const vascular::BalloonReport& report,
                  const vascular::LumenMoment& moment, CouplingState& state);

/// Force of the wall on the balloon's shaft in the step that ends at `moment`: holds its middle along the artery.
core::Tether tether_on_shaft(const CouplingModel& model, const vascular::TreatmentState& treatment,
                             const CouplingState& state, int tool, const vascular::LumenMoment& moment);

/// For the balloon's shaft, between its markers: the force of the guide's edge on the caught stent. For the guide's
/// tip: the force of the stent it pushes.
core::StretchLoad load_on_shaft(const CouplingModel& model, const core::State& rods, const CouplingState& state,
                                int tool);

}  // namespace ostium::app
