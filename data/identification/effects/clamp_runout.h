#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// The base tangent is off and turns with the roll, as in a collet that does not run true: the frame at the base is
/// tilted by `tilt_1_deg` about d1 and `tilt_2_deg` about d2 of the rolled frame. Nested: of the chosen instrument's
/// drive, the outermost if none is.
Effect clamp_runout();

}  // namespace ostium
