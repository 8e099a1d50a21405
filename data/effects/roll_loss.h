#pragma once
#include "data/effects/effect.h"

namespace ostium {

/// A fraction of the commanded roll does not arrive at the base: slip in the drive, friction along the shaft.
Effect roll_loss();

}  // namespace ostium
