#pragma once
/// The verdict on models that were fitted and scored.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

/// So few numbers beyond what is fitted that nothing can be decided, or no experiment to hold out.
bool too_small(const MeasurementSet& set, const FittedModel& declared);

/// Decides on the candidates: the verdict, the best first, then its rivals, and what to measure where it is open.
void decide(const MeasurementSet& set, const Workers& workers, Explanation& out);

}  // namespace ostium::data
