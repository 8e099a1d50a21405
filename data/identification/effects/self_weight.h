#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A weight that is declared wrong or not at all: the declared one times `scale`; where next to nothing is declared,
/// `scale` times that of solid nitinol (6,450 kg/m3) of the instrument's cross-section.
Effect self_weight();

}  // namespace ostium
