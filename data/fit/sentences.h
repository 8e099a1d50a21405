#pragma once
/// What an explanation found, in plain words.
#include "data/fit/explanation.h"

namespace ostium {

std::vector<std::string> sentences(const MeasurementSet& set, const Explanation& explanation);

/// "shaft_torsion + stress_relaxation", or "what is declared".
std::string name_of(const FittedModel& model);

}  // namespace ostium
