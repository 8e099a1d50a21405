#pragma once
/// Sets measured in a vessel: the whole insertion history is simulated with contact and friction, since wall forces
/// depend on the path.
///
/// The instruments are core rods, nested in one another, fed and turned at the base at the same slow speed in all
/// experiments, in listed order, starting from outside. Damping keeps the motion quasi-static, so that the shape
/// recorded after a rest is in equilibrium with walls and friction. All experiments have the first one's base.
#include "data/identification/forward/shape.h"

namespace ostium::data {

/// One shape per experiment. If the simulation fails, that shape and the later ones are marked as not converged.
/// `progress` may be empty. Throws std::invalid_argument if the changed numbers do not describe a rod.
std::vector<PredictedShape> insert(const MeasurementSet& set, const Changes& changes,
                                   const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace ostium::data
