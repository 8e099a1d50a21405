#pragma once
/// Sets of projections: a wire by the boundary-value solver, seen by two views of a pinhole camera.
#include "tests/support/one_wire.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::synthetic {

/// `kind`: one of undeclared_kinds() with the prefix `in_views`.
Undeclared undeclared_in_views(const std::string& kind, unsigned seed);

/// A clean set of this wire.
data::MeasurementSet views_of(const BenchWire& wire, unsigned seed);

}  // namespace ostium::synthetic
