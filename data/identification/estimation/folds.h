#pragma once
/// Held-out data: each experiment is scored once, by the fit that has not seen it.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Four folds, contiguous in listed order; whole groups where there are groups, one fold for each if there are fewer
/// than eight. One fold an experiment if there are fewer than four; none for a single experiment.
std::vector<std::vector<int>> folds_of(const MeasurementSet& set);

}  // namespace ostium::data
