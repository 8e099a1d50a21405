#pragma once
/// Sets in a tube, made by the pushed chain.
#include "tests/support/undeclared.h"

namespace ostium::synthetic {

/// `kind` is one of undeclared_kinds() that begin with `in_tube`. Throws std::runtime_error if the chain comes to no
/// rest.
Undeclared undeclared_in_tube(const std::string& kind, unsigned seed);

}  // namespace ostium::synthetic
