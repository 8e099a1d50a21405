#pragma once
/// Reads one experiment of a measured set.
#include "data/identification/measurement/measurement_set.h"
#include "data/formats/json_object.h"

namespace ostium {

/// `set` has the instruments and the experiments before this one. Throws LoadError.
Experiment read_experiment(const JsonValue& value, const MeasurementSet& set);

}  // namespace ostium
