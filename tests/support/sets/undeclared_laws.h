#pragma once
/// Laws that no effect of the library has: stiffness along the instrument, bending that is neither linear nor of one
/// known form.
#include "tests/support/sets/undeclared_world.h"

namespace ostium::synthetic {

/// "law:two_bumps", "law:wave", "law:saw" (stiffness along the instrument), "law:two_stage", "law:locking",
/// "law:stiffening" (moment against curvature): changes the world, notes the true law.
/// False: it is none of these.
bool add_law(const std::string& id, Dice& dice, const Truth& truth, Undeclared& made, World& world);

/// `kinds`, and those of laws.
std::vector<std::string> with_laws(std::vector<std::string> kinds);

}  // namespace ostium::synthetic
