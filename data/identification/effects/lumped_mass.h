#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A weight on the instrument that is declared nowhere: a marker, a torquer, a drop of glue. A dead load m g at a place
/// of its centreline.
Effect lumped_mass();

}  // namespace ostium
