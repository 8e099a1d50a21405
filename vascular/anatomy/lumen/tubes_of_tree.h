#pragma once
/// Converts a part's centreline-sphere tree to tubes, each starting at its parent's wall.
#include "vascular/anatomy/lumen/lumen_parts.h"
#include "vascular/geometry/implicit/tube.h"

namespace ostium::vascular {

/// Adds a part's tubes, named by its roles, to `tubes`, and to `leaves_m` the arc length at which each one leaves its
/// parent's wall.
void add_tubes(const LumenPart& part, std::vector<Tube>& tubes, std::vector<double>& leaves_m);

}  // namespace ostium::vascular
