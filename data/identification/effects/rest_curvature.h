#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// A set of the shaft that the declaration leaves out: k (material frame) is added to the rest curvature of the whole
/// instrument or of a stretch of it. Wires take a set where they are coiled in their hoop or bent over a finger.
/// Law: the rod's own, m = K (u - u_rest - k).
Effect rest_curvature();

}  // namespace ostium
