#pragma once
/// What an explanation found, in plain words.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

std::vector<std::string> verdict_text(const MeasurementSet& set, const Explanation& explanation);

}  // namespace ostium::data
