#pragma once
/// What instruments do to arteries that give way (vascular/treatment/artery_bed.h).
#include "app/session/coupling/coupling.h"

namespace ostium::app {

/// Finds the force of all rods on each cell, and the joints that an inflated balloon stiffens, into `scratch`, of whose
/// locator it makes use: call after look().
void find_artery_loads(const CouplingModel& model, const core::StepReport& report,
                       const vascular::TreatmentState& treatment, const vascular::TreatmentReport& treated,
                       double phase, const CouplingState& state, CouplingScratch& scratch);

/// Arteries follow these loads; contact's wall follows the arteries. Both (#cells).
void give_way(const vascular::ArteryBedModel& model, double dt_s, CouplingScratch& scratch,
              vascular::ArteryBedState& bed, std::vector<Eigen::Vector3d>& wall_aside_P);

}  // namespace ostium::app
