#pragma once
#include "data/identification/effects/effect.h"

namespace ostium {

/// The picture is too large or too small, as with a wrong magnification: measured = c + scale (true - c), with c the
/// origin of the measuring frame (`about_base` 0) or the first base (1).
Effect imaging_scale();

}  // namespace ostium
