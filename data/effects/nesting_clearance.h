#pragma once
#include "data/effects/effect.h"

namespace ostium {

/// Play between nested instruments: near the end of an outer one its inner neighbour crosses from one side of the bore
/// to the other, and what they give to each other there comes up only little by little. Of beams with play c on each
/// side and curvatures at rest that differ by k, which touch at both ends of a length s and nowhere between, the couple
/// rises from nothing at the tip to the whole, so the play is k s^2 / 6 = 2 c; half of the couple is missing over s, as
/// if the outer one ended s / 2 = sqrt(3 c / k) earlier. That is the first order in c, without what the inner one is
/// off the middle by (tests/data/nesting_clearance_test.cpp).
Effect nesting_clearance();

}  // namespace ostium
