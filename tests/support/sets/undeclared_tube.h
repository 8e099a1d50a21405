#pragma once
/// Sets in a tube, made by the pushed chain.
#include <cmath>

#include "tests/support/pushed_chain.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::synthetic {

/// Of the chains, and between measured points.
inline constexpr double segment_m = 0.5e-3, points_m = 5e-3;
inline double rounded_m(double length_m) { return segment_m * std::round(length_m / segment_m); }

/// `kind`: one of undeclared_kinds() with the prefix `in_tube`. Throws std::runtime_error if the chain finds no
/// equilibrium.
Undeclared undeclared_in_tube(const std::string& kind, unsigned seed);

/// The chain's instrument as declared in a file.
data::MeasuredInstrument declared(const pushed_chain::Wire& wire, const std::string& name, double length_m);
/// A base in the chain's plane (x, z), along x: d1 is up, along z, so u2 > 0 turns the tip up.
core::EndState base_along_x(const Eigen::Vector2d& xz_m);

}  // namespace ostium::synthetic
