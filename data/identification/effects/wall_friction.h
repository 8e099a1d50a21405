#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// Another friction between wall and instruments than declared: Coulomb's law (core/contact), static and kinetic alike.
Effect wall_friction();

}  // namespace ostium
