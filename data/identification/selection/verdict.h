#pragma once
/// The verdict on fitted and scored models.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

/// Whether too few measured numbers exceed the fitted ones to decide anything, or no experiment can be held out.
bool too_small(const MeasurementSet& set, const FittedModel& declared);

/// Where no effect is named; `fits`: nothing but noise, or no pattern, is left.
Verdict without_an_effect(bool fits, bool noise_known);

/// What lets an unknown noise be known.
NextExperiment repeat_for_noise(const MeasurementSet& set);

/// Whether the candidate removes most of what is beyond noise, with more evidence than any field without a name has.
bool removes_most_of_it(const Explanation& x, const FittedModel& candidate);

/// The setting at which a model leaves most.
NextExperiment where_most_is_left(const MeasurementSet& set, const FittedModel& model);

/// Sets the verdict, sorts the candidates (the best, its rivals, the rest), and suggests the next experiment if it is
/// open.
void decide(const MeasurementSet& set, const Workers& workers, Explanation& out);

}  // namespace ostium::data
