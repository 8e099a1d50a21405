#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A stretch of other stiffness, declared nowhere: a solder joint, a kink, a braid that ends. EI and GJ times `factor`
/// from `from_tip_mm` on, over `length_mm`. Law: the rod's own.
Effect soft_section();

}  // namespace ostium
