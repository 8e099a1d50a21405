#pragma once
/// Sets in a tube, made by the pushed chain.
#include "tests/support/pushed_chain.h"
#include "tests/support/undeclared.h"

namespace ostium::synthetic {

/// `kind`: one of undeclared_kinds() with the prefix `in_tube`. Throws std::runtime_error if the chain finds no
/// equilibrium.
Undeclared undeclared_in_tube(const std::string& kind, unsigned seed);

/// The chain's instrument as declared in a file.
data::MeasuredInstrument declared(const pushed_chain::Wire& wire, const std::string& name, double length_m);
/// A base in the chain's plane (x, z), along x: d1 is up, along z, so u2 > 0 turns the tip up.
core::EndState base_along_x(const Eigen::Vector2d& xz_m);

}  // namespace ostium::synthetic
