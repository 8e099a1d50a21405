#pragma once
/// What to measure next: the setting at which two explanations of a set predict the most different shapes.
#include "data/identification/selection/explanation.h"

namespace ostium {

/// None if no setting tells them apart by more than the noise (or 0.1 mm where it is unknown).
std::optional<NextExperiment> next_experiment(const MeasurementSet& set, const Workers& workers, const FittedModel& a,
                                              const FittedModel& b, const Noise& noise);

}  // namespace ostium
