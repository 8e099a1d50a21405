#pragma once
/// Reads measured sets. What is wrong throws LoadError: "FILE:LINE: ENTRY is VALUE; expected ...". Refused is also what
/// cannot be: a base without a direction, an instrument pushed in further than it is long, one that does not fit into
/// the next.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// `path`: the set's folder, or its measurement.json.
MeasurementSet load_measurement(const std::string& path);

/// `file` names it in messages.
MeasurementSet read_measurement(const std::string& file, const std::string& text);

/// The file that `load_measurement` reads.
std::string measurement_file(const std::string& path);

}  // namespace ostium::data
