#pragma once
/// Reads one view of a set of projections: its geometry, written out or from the tags of a DICOM frame.
#include "data/formats/json/json_object.h"
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// `set` has the earlier views, and its file's name. Throws LoadError, also where the numbers do not go together: axes
/// that are not square, a source in the detector's plane, angles that are not those of the geometry, wrong units.
MeasuredCArm read_view(const JsonValue& value, const MeasurementSet& set);

}  // namespace ostium::data
