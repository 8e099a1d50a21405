#pragma once
/// The findings of an explanation, in plain words.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

/// What is left beyond noise, with what it moves with.
std::string remaining_text(const Explanation& explanation, const std::vector<ResidualAttribution>& fields,
                           const Remaining& left);

/// Warns of stiffness beyond three of its prior's deviations: something else makes it look so; and of a declared noise
/// far beyond what is left.
void warn_of_scales(const FittedModel& model, std::vector<std::string>& warnings);

/// Puts faults before what was found of the mended set: they are effects of the data, so that what was explained then
/// is an effect.
void add_faults(const std::vector<DataFault>& faults, Explanation& explanation);

std::vector<std::string> verdict_text(const MeasurementSet& set, const Explanation& explanation);

}  // namespace ostium::data
