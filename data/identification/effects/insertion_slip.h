#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A fraction of the commanded insertion, or a length, does not arrive: rollers slip, the zero is off.
Effect insertion_slip();

}  // namespace ostium
