#pragma once
/// An explanation as files: explanation.json (schema ostium-explanation/1), explanation.html, and the set amended by
/// what was found.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

std::string to_json(const Explanation& explanation);

/// One page that needs nothing else: plots inside, no scripts.
std::string to_html(const MeasurementSet& set, const Explanation& explanation);

/// `text`, the set's measurement.json, with the fitted stiffness and the accepted effects written in.
std::string amended(const std::string& text, const MeasurementSet& set, const Explanation& explanation);

/// Instrument `i` of the set as a file (schema ostium-instrument/1) that every other command takes, with the fitted
/// stiffness and with the effects that are in the instrument: what is in the rig, the room or the picture stays in the
/// amended set. What relaxes has done so as long as in the set's longest experiment.
std::string instrument_json(const MeasurementSet& set, const Explanation& explanation, std::size_t i);

}  // namespace ostium::data
