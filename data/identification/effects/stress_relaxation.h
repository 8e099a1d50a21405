#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// What a heat-set instrument, one that is curved at rest, loses with the time t in position, with two branches
/// (generalised Maxwell solid): 1 - f1 (1 - exp(-t / t1)) - f2 (1 - exp(-t / t2)). Nested with others, which hold it
/// off its shape, it is its modulus that relaxes; alone, its rest curvature.
Effect stress_relaxation();

}  // namespace ostium
