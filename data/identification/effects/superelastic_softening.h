#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// Bending that softens beyond a curvature, as superelastic nitinol does; core/rod/superelastic.h has the law. For an
/// instrument alone.
Effect superelastic_softening();

}  // namespace ostium
