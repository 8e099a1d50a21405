#pragma once
/// The wall of the vessel in which a set was measured.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Reads the mesh that the set names and orients it outwards. Throws LoadError if it cannot be read, or if a base lies
/// outside it.
std::shared_ptr<const core::SurfaceDescription> read_wall(const MeasurementSet& set);

}  // namespace ostium::data
