#pragma once
/// The moment-curvature law of a rod: which moment a joint's cell answers to its strain.
///
/// A law is a plain struct with its parameters per joint and one template,
///   MomentResponse<T> operator()(const V3<T>& strain, int joint) const;
///   double energy(const V3<double>& strain, int joint) const;   // per length, J/m
/// where `strain` = u - u_rest (1/m, material axes d1, d2, d3), T is double or four neighbouring joints side by side,
/// and the tangent is symmetric and positive definite. Adding one: a header here, its name in `MomentLaw` below, the
/// branch in rod.cpp that chooses it, and its test.
#include <variant>

#include "core/math/field.h"

namespace ostium {

template <class T>
struct MomentResponse {
  V3<T> moment;   ///< N m, in the material frame
  S3<T> tangent;  ///< d moment / d strain, N m2
};

/// m_k = K_k (u_k - u_rest,k), with K = (EI1, EI2, GJ).
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
};

using MomentLaw = std::variant<LinearElastic>;

}  // namespace ostium
