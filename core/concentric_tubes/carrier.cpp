#include "core/concentric_tubes/carrier.h"

#include "core/concentric_tubes/twist.h"
#include "core/math/rotation.h"
#include "core/rod/initial_state.h"

namespace ostium::core {

void turn_carrier(const Concentric& nest, const EndState& base, const ConcentricState& state, Rod& rod,
                  EndState& held) {
  set_concentric_rest_curvature(nest, state, rod);
  const Eigen::Quaterniond q = Eigen::Quaterniond(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]) *
                               Eigen::AngleAxisd(state.base_roll_rad[nest.reference], Eigen::Vector3d::UnitZ());
  held.p_W = base.p_W;
  held.q_W = {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Matrix3Xd strains(const Rod& rod, const RodState& state) {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, rod.nodes());
  Q4<double> before = state.base.frame();
  for (int k = 0; k < rod.elements; ++k) {
    const Q4<double> here = load4<double>(state.orientation, k);
    u.col(k) = to_eigen(rotation_vector(conjugate(before) * here)) / rod.joint_length.at(0)[k];
    before = here;
  }
  return u;
}

ConcentricState straight_state(const Concentric& nest, const EndState& base) {
  const int n = static_cast<int>(nest.parts.size()), N = nest.carrier.rods[0].elements;
  ConcentricState state;
  state.base_roll_rad.resize(n);
  for (int i = 0; i < n; ++i) state.base_roll_rad[i] = nest.parts[i].roll_rad;
  state.roll_rad = (state.base_roll_rad.array() - state.base_roll_rad[nest.reference]).matrix().replicate(1, N);
  state.moment_N_m.setZero(3, N + 1);
  Rod rod = nest.carrier.rods[0];
  EndState held = base;
  turn_carrier(nest, base, state, rod, held);
  state.carrier = make_state(nest.carrier, {held});
  return state;
}

Eigen::Vector4d tip_frame(const Concentric& nest, const ConcentricState& state, int part) {
  const Rod& whole = nest.carrier.rods[0];
  const RodState& carrier = state.carrier.rods[0];
  const int last = std::max(nest.last_element[part], 0);
  Rod rod = whole;
  set_concentric_rest_curvature(nest, state, rod);
  // The frame is that of the element's middle; beyond it, the next joint's cell follows its rest curvature.
  const double from_base = whole.total_length_m - 0.5 * (whole.node_from_tip_m[last] + whole.node_from_tip_m[last + 1]);
  const Eigen::Vector3d u = rod.rest_curvature[last + 1];
  return coefficients((quaternion(carrier.orientation[last]) * rotation(u * (nest.parts[part].inserted_m - from_base)) *
                       Eigen::AngleAxisd(state.roll_rad(part, last), Eigen::Vector3d::UnitZ()))
                          .normalized());
}

}  // namespace ostium::core
