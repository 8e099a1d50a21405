#pragma once
/// Sets of projections: a wire by the boundary-value solver, seen by two views of a pinhole camera.
#include "tests/support/undeclared.h"

namespace ostium::synthetic {

/// `kind`: one of undeclared_kinds() with the prefix `in_views`.
Undeclared undeclared_in_views(const std::string& kind, unsigned seed);

}  // namespace ostium::synthetic
