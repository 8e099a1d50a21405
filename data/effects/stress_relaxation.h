#pragma once
#include "data/effects/effect.h"

namespace ostium {

/// The modulus of heat-set instruments, those that are curved at rest, relaxes at constant strain with two branches
/// (generalised Maxwell solid): E(t) = E (1 - f1 (1 - exp(-t / t1)) - f2 (1 - exp(-t / t2))), t the time in position.
Effect stress_relaxation();

}  // namespace ostium
