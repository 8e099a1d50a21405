#pragma once
/// Reads a set of projections: a wire seen by the views of a C-arm, as pixels along it without correspondence.
#include "data/formats/json/json_value.h"
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Throws LoadError. The files that it names (frames, a table of polylines) lie beside `file`'s.
MeasurementSet read_projections(const JsonValue& file);

}  // namespace ostium::data
