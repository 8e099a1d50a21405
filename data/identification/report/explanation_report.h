#pragma once
/// Writes an explanation: explanation.json (schema ostium-explanation/1), explanation.html, and the set amended by the
/// findings.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

std::string to_json(const Explanation& explanation);

/// A self-contained page: plots inline, no scripts.
std::string to_html(const MeasurementSet& set, const Explanation& explanation);

/// `text`, the set's measurement.json, with what it names in other files (frames of views, a table of clicks) written
/// out, so that it can lie elsewhere.
std::string written_out(const std::string& text, const MeasurementSet& set);

/// `text`, the set's measurement.json, written out, with the fitted stiffness and the accepted effects added.
std::string amended(const std::string& text, const MeasurementSet& set, const Explanation& explanation);

/// Instrument `i` of the set as a file (schema ostium-instrument/1) for all other commands, with the fitted stiffness
/// and the effects that belong to the instrument; effects of the rig, the room or the imaging stay in the amended set.
/// Relaxation is applied for the time of the set's longest experiment. `name`: what its file is called, without .json;
/// empty: made from the instrument's.
std::string instrument_json(const MeasurementSet& set, const Explanation& explanation, std::size_t i,
                            const std::string& name = "");

}  // namespace ostium::data
