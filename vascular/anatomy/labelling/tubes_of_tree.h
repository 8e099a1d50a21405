#pragma once
/// A part's tree of centrelines as tubes, each from where it leaves its parent's wall.
#include "vascular/anatomy/labelling/lumen_parts.h"
#include "vascular/geometry/implicit/tube.h"

namespace ostium::vascular {

/// Adds the tubes of one part to `tubes`, named by the part's roles, and to `leaves_m` the arc length of each at which
/// it leaves its parent's wall.
void add_tubes(const LumenPart& part, std::vector<Tube>& tubes, std::vector<double>& leaves_m);

}  // namespace ostium::vascular
