#include "core/base/tolerances.h"
#include "core/concentric_tubes/carrier.h"
#include "core/concentric_tubes/twist.h"
#include "core/math/rotation.h"

namespace ostium::core {

namespace {

void take_moments(const Rod& rod, ConcentricState& state) {
  const Eigen::Matrix3Xd strain = strains(rod, state.carrier.rods[0]);
  for (int k = 0; k < rod.elements; ++k)
    state.moment_N_m.col(k) =
        stiffness_at_rest(rod, k).cwiseProduct(Eigen::Vector3d(strain.col(k)) - rod.rest_curvature[k]);
}

/// Tilts a rod slightly, more with distance from its base, to leave a balanced but unstable shape such as a long wire
/// standing upright. The direction is arbitrary but always the same.
void lean(const Rod& rod, RodState& state) {
  const Eigen::Vector3d axis = quaternion(state.base.q_W) * Eigen::Vector3d(1, 0.3, 0).normalized();
  for (int j = 0; j < rod.elements; ++j)
    state.orientation.set(
        j, coefficients(rotation(1e-2 * (j + 1) / rod.elements * axis) * quaternion(state.orientation[j])));
}

}  // namespace

ConcentricEquilibrium find_equilibrium(const Concentric& nest, const EndState& base,
                                       const Eigen::Vector3d& tip_force_W_N, ConcentricState& state) {
  Model carrier = nest.carrier;
  Scratch scratch(carrier);
  Inputs inputs;
  inputs.rods.resize(1);
  inputs.rods[0].tip_force_W_N = tip_force_W_N;
  std::vector<RodEquilibrium> report;

  const bool turns = nest.parts.size() > 1 || nest.parts[0].shaft_rad_per_Nm > 0;
  if (!turns) state.base_roll_rad[0] = nest.parts[0].roll_rad;
  ConcentricEquilibrium out;
  int leans = 0;
  while (out.rounds < tolerances::max_concentric_rounds && !out.converged) {
    ++out.rounds;
    const TwistSolution twist = turns ? solve_twist(nest, state) : TwistSolution{};
    out.turn_rad = twist.turn_rad;
    if (!twist.converged) return out;
    out.converged = turns && out.rounds > 1 && out.turn_rad < tolerances::concentric_tolerance_rad;
    if (out.converged) break;  // the carrier already has the shape that these angles give
    turn_carrier(nest, base, state, carrier.rods[0], state.carrier.rods[0].base);
    scratch.rods[0].inside.rest_curvature = carrier.rods[0].rest_curvature;
    find_equilibrium(carrier, inputs, state.carrier, scratch, report);
    out.negative_directions = report[0].negative_directions;
    const bool stable = report[0].converged && out.negative_directions == 0;
    if (!stable && leans++ < tolerances::max_concentric_leans) {
      lean(carrier.rods[0], state.carrier.rods[0]);
      continue;
    }
    if (!report[0].converged) return out;
    take_moments(carrier.rods[0], state);
    out.converged = !turns;
  }
  const Rod& rod = carrier.rods[0];
  Eigen::Vector3d load = rod.total_mass_kg * carrier.gravity_W + tip_force_W_N;
  for (int i = 0; i < rod.dead_load.size(); ++i) load += rod.dead_load[i];
  out.base_push_N = -load.dot(to_eigen(director3(state.carrier.rods[0].base.frame())));
  return out;
}

}  // namespace ostium::core
