#pragma once
/// Sets of nested tubes with play, made by two chains.
#include "tests/support/undeclared.h"

namespace ostium::synthetic {

/// Tubes in one plane, curved to the same side or to opposite ones, some with a load at the tip, whose play no file
/// declares. Throws std::runtime_error if the chains come to no rest.
Undeclared undeclared_play(unsigned seed);

}  // namespace ostium::synthetic
