#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// The measuring frame is rigidly off although it is declared given: turned about the first base, and shifted.
Effect registration();

}  // namespace ostium
