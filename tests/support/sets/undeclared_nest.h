#pragma once
/// Sets of nested tubes with play, made by two chains.
#include "tests/support/sets/undeclared.h"

namespace ostium::synthetic {

/// Planar tubes, curved to the same side or to opposite sides, some with a load at the tip, whose play is not declared.
/// Throws std::runtime_error if the chains find no equilibrium.
Undeclared undeclared_play(unsigned seed);

}  // namespace ostium::synthetic
