#pragma once
/// m_k = K_k (u_k - u_rest,k), with K = (EI1, EI2, GJ) (Kirchhoff's rod; thesis, eq. 3).
#include "core/material/bending_curve.h"
#include "core/material/moment_response.h"
#include "core/math/field.h"

namespace ostium::core {

struct LinearElastic {
  Field<3> stiffness;  ///< N m2, (#joints)

  template <class T>
  MomentResponse<T> operator()(const V3<T>& strain, int joint) const {
    const V3<T> K = load3<T>(stiffness, joint);
    return {{K.x * strain.x, K.y * strain.y, K.z * strain.z}, {K.x, T{}, T{}, K.y, T{}, K.z}};
  }

  double energy(const V3<double>& strain, int joint) const {
    return 0.5 * dot(strain, (*this).operator()<double>(strain, joint).moment);
  }

  /// Sets a joint's cell from the integrals of (1/EI1, 1/EI2, 1/GJ) over its length.
  void set_cell(int joint, double length_m, const Eigen::Vector3d& compliance, const BendingIntegrals&) {
    stiffness.set(joint, length_m * compliance.cwiseInverse());
  }

  void resize(int joints) { stiffness.resize(joints); }
  /// Copies joints `from` to `to` - 1 of another rod with this law, to `joint` onwards.
  void copy(const LinearElastic& other, int from, int to, int joint) {
    copy_entries(other.stiffness, from, to, stiffness, joint);
  }
};

}  // namespace ostium::core
