#pragma once
#include "data/effects/effect.h"

namespace ostium {

/// Play between nested instruments: near the end of an outer one its inner neighbour can bend by itself until it meets
/// the bore. With the clearance c and curvatures at rest that differ by k there, a length s with k s^2 / 2 = c does not
/// feel the other, so the outer one works as if it ended s earlier. (Play in nested tubes: Ha, Fang, Dupont 2019, IEEE
/// Robot Autom Lett; this law is the first order of it, an estimate.)
Effect nesting_clearance();

}  // namespace ostium
