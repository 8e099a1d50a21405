#pragma once
/// Reads measured sets. Errors throw LoadError: "FILE:LINE: ENTRY is VALUE; expected ...". Impossible setups are
/// refused too: a base without a direction, an instrument inserted further than its length, one that does not fit into
/// the next.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// `path`: the set's folder, or its measurement.json.
MeasurementSet load_measurement(const std::string& path);

/// `file` is the name used in messages.
MeasurementSet read_measurement(const std::string& file, const std::string& text);

/// The path of the file that `load_measurement` reads.
std::string measurement_file(const std::string& path);

}  // namespace ostium::data
