#include <algorithm>

#include "core/concentric_tubes/carrier.h"

namespace ostium::core {

namespace {

/// Column of `values`, sampled at the rising positions `at`, interpolated linearly at x.
Eigen::VectorXd between(const Eigen::VectorXd& at, const Eigen::MatrixXd& values, double x) {
  const Eigen::Index last = values.cols() - 1;
  const Eigen::Index i =
      std::clamp<Eigen::Index>(std::upper_bound(at.data(), at.data() + last + 1, x) - at.data(), 1, last);
  const double t = std::clamp((x - at[i - 1]) / (at[i] - at[i - 1]), 0.0, 1.0);
  return (1 - t) * values.col(i - 1) + t * values.col(i);
}

/// Distances of the joints and of the element middles from the base, as fractions of the length.
Eigen::VectorXd joint_fractions(const Rod& rod) {
  Eigen::VectorXd at(rod.elements);
  for (int k = 0; k < rod.elements; ++k) at[k] = 1 - rod.node_from_tip_m[k] / rod.total_length_m;
  return at;
}
Eigen::VectorXd element_fractions(const Rod& rod) {
  return joint_fractions(rod) +
         Eigen::Map<const Eigen::VectorXd>(rod.length.at(0), rod.elements) / (2 * rod.total_length_m);
}

}  // namespace

ConcentricState carried_over(const Concentric& nest, const EndState& base, const Concentric& before_nest,
                             const ConcentricState& before) {
  ConcentricState state = straight_state(nest, base);
  const Rod &rod = nest.carrier.rods[0], &rod_before = before_nest.carrier.rods[0];
  for (Eigen::Index i = 0; i < state.base_roll_rad.size(); ++i)
    state.base_roll_rad[i] += before.base_roll_rad[i] - before_nest.parts[i].roll_rad;
  Rod turned = rod;
  RodState& carrier = state.carrier.rods[0];
  turn_carrier(nest, base, state, turned, carrier.base);

  const Eigen::VectorXd joints_before = joint_fractions(rod_before), elements_before = element_fractions(rod_before);
  const Eigen::VectorXd joints = joint_fractions(rod), elements = element_fractions(rod);
  const Eigen::MatrixXd strain = strains(rod_before, before.carrier.rods[0]).leftCols(rod_before.elements);
  const Eigen::MatrixXd moment = before.moment_N_m.leftCols(rod_before.elements);
  Eigen::Quaterniond q = quaternion(carrier.base.q_W);
  Eigen::Vector3d p = base.p_W;
  for (int j = 0; j < rod.elements; ++j) {
    const Eigen::Vector3d u = between(joints_before, strain, joints[j]);
    q = (q * rotation(u * rod.joint_length.at(0)[j])).normalized();
    carrier.orientation.set(j, coefficients(q));
    carrier.position.set(j, p);
    p += rod.length.at(0)[j] * (q * Eigen::Vector3d::UnitZ());
    state.moment_N_m.col(j) = between(joints_before, moment, joints[j]);
    // Relative to the drive's roll, so that a part whose drive turns on carries its angles along.
    const auto drives = [](const Concentric& n, int i) { return n.parts[i].roll_rad - n.parts[n.reference].roll_rad; };
    const Eigen::VectorXd roll = between(elements_before, before.roll_rad, elements[j]);
    for (int i = 0; i < static_cast<int>(nest.parts.size()); ++i)
      state.roll_rad(i, j) =
          roll[i] +
          (nest.reference == before_nest.reference ? drives(nest, i) - drives(before_nest, i) : -roll[nest.reference]);
  }
  carrier.position.set(rod.elements, p);
  carrier.position_before = carrier.position;
  return state;
}

}  // namespace ostium::core
