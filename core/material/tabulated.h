#pragma once
/// A moment-curvature curve of any form that rises (bending_curve.h), and softening (superelastic.h) beside it. With
/// k = u - u_rest across d3, kappa^2 = k K k / (mean of EI1 and EI2), and knots kappa_j at which the tangent's slope
/// changes by a_j,
///   W = softening's W + mean(EI) (sum over j of a_j (kappa - kappa_j)+^3 / 6),
///   m = K k (softening's part + sum over j of a_j (kappa - kappa_j)+^2 / (2 kappa)).
/// W is convex where the tangent is positive. No hysteresis; twist stays linear. All joints have the same knots.
#include "core/material/superelastic.h"

namespace ostium::core {

struct Tabulated {
  Superelastic soft;
  Field<bending_knots> bends;  ///< a_j, m, (#joints), averaged over the cell
  BendingKnots knots;

  template <class T>
  MomentResponse<T> operator()(const V3<T>& strain, int joint) const {
    MomentResponse<T> out = soft(strain, joint);
    if (knots.count == 0) return out;
    const V3<T> K = load3<T>(soft.stiffness, joint);
    const T m1 = K.x * strain.x, m2 = K.y * strain.y, mean = 0.5 * (K.x + K.y);
    const T square = madd(m1, strain.x, m2 * strain.y) / mean + least_square, kappa = square_root(square);
    T twice = T{}, slope = T{};
    for (int j = 0; j < knots.count; ++j) {
      const T beyond = largest(kappa - knots.at_per_m[j], T{}), more = load<T>(bends.at(j) + joint) * beyond;
      slope = slope + more, twice = madd(more, beyond, twice);
    }
    const T part = 0.5 * twice / kappa, rise = (slope - part) / (mean * square);
    out.moment.x = madd(part, m1, out.moment.x), out.moment.y = madd(part, m2, out.moment.y);
    out.tangent.xx = madd(rise * m1, m1, madd(part, K.x, out.tangent.xx));
    out.tangent.xy = madd(rise * m1, m2, out.tangent.xy);
    out.tangent.yy = madd(rise * m2, m2, madd(part, K.y, out.tangent.yy));
    return out;
  }

  double energy(const V3<double>& strain, int joint) const {
    const V3<double> K = load3<double>(soft.stiffness, joint);
    const double mean = 0.5 * (K.x + K.y);
    const double kappa = std::sqrt((K.x * strain.x * strain.x + K.y * strain.y * strain.y) / mean + least_square);
    double sum = 0;
    for (int j = 0; j < knots.count; ++j) {
      const double beyond = std::max(kappa - knots.at_per_m[j], 0.0);
      sum += bends.at(j)[joint] * beyond * beyond * beyond;
    }
    return soft.energy(strain, joint) + mean * sum / 6;
  }

  void set_cell(int joint, double length_m, const Eigen::Vector3d& compliance, const BendingIntegrals& cell) {
    soft.set_cell(joint, length_m, compliance, cell);
    for (int j = 0; j < knots.count; ++j) bends.at(j)[joint] = cell.bends_m2[j] / length_m;
  }

  void resize(int joints) { soft.resize(joints), bends.resize(joints); }
  void copy(const Tabulated& other, int from, int to, int joint) {
    soft.copy(other.soft, from, to, joint);
    copy_entries(other.bends, from, to, bends, joint);
  }
  /// Joints of a rod with a law without a curve that is nested with this one.
  template <class Law>
  requires std::is_same_v<Law, Superelastic> || std::is_same_v<Law, LinearElastic>
  void copy(const Law& other, int from, int to, int joint) {
    soft.copy(other, from, to, joint);
    for (int j = 0; j < bending_knots; ++j) std::fill_n(bends.at(j) + joint, to - from, 0.0);
  }

 private:
  static constexpr double least_square = 1e-12;  // (1/m)^2, against a division by zero
};

}  // namespace ostium::core
