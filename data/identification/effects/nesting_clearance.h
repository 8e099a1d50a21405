#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// Play between nested instruments: near the end of an outer one its inner neighbour crosses from one side of the bore
/// to the other, and comes out at an angle. How far and at which angle is worked out for two beams of small deflection
/// that touch as they must (beams_with_play.h), and put into the shared centreline as a kink; loads at the innermost
/// tip included, twist and weight left out.
Effect nesting_clearance();

}  // namespace ostium
