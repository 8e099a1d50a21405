#pragma once
/// Forces of devices on a tool's rod: an open balloon holds its shaft by its bonds; a guide's edge pushes a stent
/// caught on it, and that stent pushes the guide.
#include "app/session/coupling/coupling.h"

namespace ostium::app {

/// How far the body of a balloon that the wall holds lies ahead of its place on its shaft, along the artery: the mean
/// of what both markers see. Body and shaft pull each other by this one measure; by two, they would drive each other
/// along.
double ahead_of_shaft_m(const CouplingModel& model, const core::State& rods, const vascular::BalloonState& body,
                        const CoupledBalloon& placed, const vascular::LumenMoment& moment);

/// What an open balloon that the wall holds does to its shaft, along the artery, in the step that ends at `moment`.
std::array<core::Tether, core::max_tethers> tethers_on_shaft(const CouplingModel& model, const core::State& rods,
                                                             const vascular::TreatmentState& treatment,
                                                             const CouplingState& state, int tool,
                                                             const vascular::LumenMoment& moment);

/// For the balloon's shaft, between its markers: the force of the guide's edge on the caught stent. For the guide's
/// tip: the force of the stent it pushes.
core::StretchLoad load_on_shaft(const CouplingModel& model, const core::State& rods, const CouplingState& state,
                                int tool);

}  // namespace ostium::app
