#pragma once
/// Reads one experiment of a measured set.
#include "data/formats/json/json_object.h"
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// All but what was measured. `set` contains the instruments and the earlier experiments. Throws LoadError.
Experiment read_setting(const JsonObject& entry, const MeasurementSet& set);

/// `set` contains the instruments and the earlier experiments. Throws LoadError.
Experiment read_experiment(const JsonValue& value, const MeasurementSet& set);

}  // namespace ostium::data
