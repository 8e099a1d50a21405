#pragma once
/// The wall of the vessel that a set was measured in.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Reads the mesh that the set names, turned to face outwards. Throws LoadError if it cannot be read, or if a base lies
/// outside of it.
std::shared_ptr<const core::SurfaceDescription> read_wall(const MeasurementSet& set);

}  // namespace ostium::data
