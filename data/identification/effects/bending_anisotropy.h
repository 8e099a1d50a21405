#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// Bending stiffness that differs between two axes across the instrument: a flattened core, a tube with a seam.
/// EI1 = EI sqrt(ratio), EI2 = EI / sqrt(ratio) about axes that lie `axis_deg` from d1 and d2, right-handed about d3.
/// Law: the rod's own (Kirchhoff's, with two stiffnesses). For an instrument alone.
Effect bending_anisotropy();

}  // namespace ostium
