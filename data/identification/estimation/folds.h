#pragma once
/// Cross-validation folds: each experiment is scored once, by a fit that did not use it.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Four folds, contiguous in listed order. Groups are never split; with fewer than eight groups there is one fold per
/// group. With fewer than four experiments, one fold per experiment; none for a single experiment.
std::vector<std::vector<int>> folds_of(const MeasurementSet& set);

}  // namespace ostium::data
