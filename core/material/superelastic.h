#pragma once
/// Softening bending: linear below a curvature kc, and with the share r of that stiffness far beyond it, as in nitinol
/// when austenite turns into martensite (the moment curve of a superelastic wire flattens; Auricchio, Taylor, Lubliner
/// 1997, Comput Methods Appl Mech Eng 146:281). No hysteresis: all follows from one energy per length, with k = u -
/// u_rest across d3 and q = k K k / (mean of EI1 and EI2):
///   W = r k K k / 2 + (1 - r) kc^2 mean(EI) (sqrt(1 + q / kc^2) - 1),   m = K k (r + (1 - r) / sqrt(1 + q / kc^2)).
/// W is convex, so the tangent is positive definite. Twist stays linear.
#include "core/material/linear_elastic.h"

namespace ostium::core {

struct Superelastic {
  Field<3> stiffness;  ///< N m2, (#joints)
  Field<2> softening;  ///< 1 / (kc^2 mean(EI)) and 1 - r, (#joints); 0 and 0 where it stays linear

  template <class T>
  MomentResponse<T> operator()(const V3<T>& strain, int joint) const {
    const V3<T> K = load3<T>(stiffness, joint);
    const T scale = load<T>(softening.at(0) + joint), lost = load<T>(softening.at(1) + joint);
    const T m1 = K.x * strain.x, m2 = K.y * strain.y;  // moments of the linear rod
    const T beyond = madd(scale, madd(m1, strain.x, m2 * strain.y), T{} + 1.0);
    const T root = 1.0 / square_root(beyond);
    const T part = madd(lost, root, 1.0 - lost), fall = lost * scale * root / beyond;
    return {
        {part * m1, part * m2, K.z * strain.z},
        {nmadd(fall * m1, m1, part * K.x), nmadd(fall * m1, m2, T{}), T{}, nmadd(fall * m2, m2, part * K.y), T{}, K.z}};
  }

  double energy(const V3<double>& strain, int joint) const {
    const V3<double> K = load3<double>(stiffness, joint);
    const double scale = softening.at(0)[joint], lost = softening.at(1)[joint];
    const double square = K.x * strain.x * strain.x + K.y * strain.y * strain.y;
    // (sqrt(1 + a) - 1) / a without cancellation.
    const double soft = square / (1 + std::sqrt(1 + scale * square));
    return 0.5 * ((1 - lost) * square + K.z * strain.z * strain.z) + lost * soft;
  }

  /// As LinearElastic's.
  void set_cell(int joint, double length_m, const Eigen::Vector3d& compliance, const BendingIntegrals& cell) {
    const Eigen::Vector3d K = length_m * compliance.cwiseInverse();
    stiffness.set(joint, K);
    const double per_kc = cell.softening.x() / length_m;
    softening.at(0)[joint] = per_kc * per_kc / (0.5 * (K.x() + K.y()));
    softening.at(1)[joint] = cell.softening.y() / length_m;
  }

  void resize(int joints) { stiffness.resize(joints), softening.resize(joints); }
  void copy(const Superelastic& other, int from, int to, int joint) {
    copy_entries(other.stiffness, from, to, stiffness, joint);
    copy_entries(other.softening, from, to, softening, joint);
  }
  /// Joints of a linear rod that is nested with this one.
  void copy(const LinearElastic& other, int from, int to, int joint) {
    copy_entries(other.stiffness, from, to, stiffness, joint);
    for (int i = 0; i < to - from; ++i) softening.set(joint + i, Eigen::Vector2d::Zero());
  }
};

}  // namespace ostium::core
