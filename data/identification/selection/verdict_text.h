#pragma once
/// The findings of an explanation, in plain words.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

std::vector<std::string> verdict_text(const MeasurementSet& set, const Explanation& explanation);

}  // namespace ostium::data
