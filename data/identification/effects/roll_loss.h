#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A fraction of the commanded roll, or a dead band counted from zero, does not arrive at the base: slip in the drive,
/// play, friction along the shaft.
Effect roll_loss();

}  // namespace ostium
