#pragma once
/// The angles of nested instruments about their common centreline, at fixed carrier moment.
///
/// The unknowns are the angles b_i at the base and a_i in each element that part i reaches (none for the reference,
/// whose frame is the carrier's). With k_i the rest curvature of part i, M the carrier's moment, C_i its shaft's
/// compliance, r_i the roll of its drive, and the carrier's strain eliminated, they minimise
///   sum_i (b_i - r_i)^2 / 2 C_i - M_z(0) b_ref
///   - integral of |sum_i EI_i Rz(a_i) k_i + M_xy|^2 / (2 sum EI_i)
///   + integral of sum_i GJ_i a_i'^2 / 2 - (sum_i GJ_i a_i' - M_z)^2 / (2 sum GJ_i)
#include "core/concentric_tubes/concentric.h"

namespace ostium::core {

struct TwistSolution {
  bool converged = true;
  double turn_rad = 0;  ///< largest change of an angle
};

/// Newton's method with descent, from the angles in `state` to a minimum.
TwistSolution solve_twist(const Concentric& nest, ConcentricState& state);

/// Sets the carrier's rest curvature from the angles in `state`, if there are several parts.
void set_concentric_rest_curvature(const Concentric& nest, const ConcentricState& state, Rod& carrier);

}  // namespace ostium::core
