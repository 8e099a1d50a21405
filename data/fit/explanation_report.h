#pragma once
/// An explanation as files: explanation.json (schema ostium-explanation/1), explanation.html, and the set amended by
/// what was found.
#include "data/fit/explanation.h"

namespace ostium {

std::string to_json(const Explanation& explanation);

/// One page that needs nothing else: plots inside, no scripts.
std::string to_html(const MeasurementSet& set, const Explanation& explanation);

/// `text`, the set's measurement.json, with the fitted stiffness and the accepted effects written in.
std::string amended(const std::string& text, const MeasurementSet& set, const Explanation& explanation);

}  // namespace ostium
