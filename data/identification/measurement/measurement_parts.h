#pragma once
/// What sets of every kind declare alike: instruments, gravity and vessel, effects, and the setting of an experiment.
/// Each throws LoadError.
#include "data/formats/json/json_object.h"
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Of the set's own object.
void read_instruments(const JsonObject& root, MeasurementSet& set);
void read_environment(const JsonValue& environment, MeasurementSet& set);
void read_effects(const JsonObject& root, MeasurementSet& set);
/// Once the experiments are read. `noise`: the key that declares it.
void require_noise_above_rounding(const JsonValue& noise, const MeasurementSet& set);

}  // namespace ostium::data
