#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A wall that gives way: a force per length of instrument and depth, in place of a rigid one (core/surface). A
/// silicone or arterial wall of modulus E and thickness h on a lumen of radius R: of the order of E h / R.
Effect wall_compliance();

}  // namespace ostium
