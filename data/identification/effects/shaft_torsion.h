#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// Twist of the straight shafts between the drives and the base: a tube of GJ and length l turns by `compliance` T l /
/// GJ under the torque T. 0: as if rigid, which is what a set declares; 1: as its own sections say.
Effect shaft_torsion();

}  // namespace ostium
