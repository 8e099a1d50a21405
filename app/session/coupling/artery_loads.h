#pragma once
/// What instruments do to arteries that give way (vascular/treatment/artery_bed.h).
#include "app/session/coupling/coupling.h"

namespace ostium::app {

/// Finds the force of all rods on each cell, and the joints that an inflated balloon stiffens, into `scratch`. Of a
/// moment's last look, with its locator.
void find_artery_loads(const CouplingModel& model, const core::StepReport& report,
                       const vascular::TreatmentState& treatment, const vascular::BalloonReport& balloon,
                       const vascular::LumenMoment& moment, const CouplingState& state, CouplingScratch& scratch);

}  // namespace ostium::app
