#pragma once
/// Rotations as unit quaternions q = (w, x, y, z), over `double` or four `Lanes`. Active, right-handed: R(q) maps
/// material components to world components; its columns are the directors d1, d2, d3.
#include <Eigen/Geometry>

#include "core/math/lanes.h"

namespace ostium::core {

template <class T>
inline Q4<T> operator*(const Q4<T>& a, const Q4<T>& b) {
  return {nmadd(a.z, b.z, nmadd(a.y, b.y, nmadd(a.x, b.x, a.w * b.w))),
          nmadd(a.z, b.y, madd(a.y, b.z, madd(a.x, b.w, a.w * b.x))),
          nmadd(a.x, b.z, madd(a.z, b.x, madd(a.y, b.w, a.w * b.y))),
          nmadd(a.y, b.x, madd(a.x, b.y, madd(a.z, b.w, a.w * b.z)))};
}
template <class T>
inline Q4<T> conjugate(const Q4<T>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
template <class T>
inline Q4<T> normalised(const Q4<T>& q) {
  const T scale = 1.0 / square_root(madd(q.w, q.w, madd(q.x, q.x, madd(q.y, q.y, q.z * q.z))));
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}
/// Third director, tangent to the rod.
template <class T>
inline V3<T> director3(const Q4<T>& q) {
  return {2.0 * madd(q.x, q.z, q.w * q.y), 2.0 * nmadd(q.w, q.x, q.y * q.z),
          nmadd(q.x + q.x, q.x, nmadd(q.y + q.y, q.y, T{} + 1.0))};
}
/// First director.
template <class T>
inline V3<T> director1(const Q4<T>& q) {
  return {nmadd(q.y + q.y, q.y, nmadd(q.z + q.z, q.z, T{} + 1.0)), 2.0 * madd(q.x, q.y, q.w * q.z),
          2.0 * nmadd(q.w, q.y, q.x * q.z)};
}
template <class T>
inline M3<T> matrix(const Q4<T>& q) {
  const T x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z, one = T{} + 1.0;
  return {{nmadd(q.y, y2, nmadd(q.z, z2, one)), nmadd(q.w, z2, q.x * y2), madd(q.w, y2, q.x * z2)},
          {madd(q.w, z2, q.x * y2), nmadd(q.x, x2, nmadd(q.z, z2, one)), nmadd(q.w, x2, q.y * z2)},
          {nmadd(q.w, y2, q.x * z2), madd(q.w, x2, q.y * z2), nmadd(q.x, x2, nmadd(q.y, y2, one))}};
}
/// Rotation by a small vector `phi` by Cayley's map, not normalised: exact in direction, |phi|^3 / 12 short in angle,
/// and a rotation for any phi.
template <class T>
inline Q4<T> small_rotation(const V3<T>& phi) {
  return {T{} + 1.0, 0.5 * phi.x, 0.5 * phi.y, 0.5 * phi.z};
}
/// q turned by the small world-frame rotation vector `phi`.
template <class T>
inline Q4<T> turned(const V3<T>& phi, const Q4<T>& q) {
  return normalised(small_rotation(phi) * q);
}

/// Rotation vector of a unit quaternion (angle in [0, pi]); scalar, for all angles.
inline V3<double> rotation_vector_any(const Q4<double>& q) {
  const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const double scale = sine < 1e-12 ? 2.0 : 2.0 * std::atan2(sine, std::fabs(q.w)) / sine;
  return std::copysign(scale, q.w) * V3<double>{q.x, q.y, q.z};
}
/// Rotation vector of a unit quaternion. Up to 0.6 rad by the series of 2 asin(s) / s in s = |(x, y, z)| (error below
/// 1e-15), beyond that by the scalar function.
template <class T>
inline V3<T> rotation_vector(const Q4<T>& q) {
  const T s2 = madd(q.x, q.x, madd(q.y, q.y, q.z * q.z));
  // asin(s) / s = sum c_k s^(2k) with c_k = (2k)! / (4^k (k!)^2 (2k + 1))
  constexpr double c[] = {1.0,
                          1.0 / 6.0,
                          3.0 / 40.0,
                          5.0 / 112.0,
                          35.0 / 1152.0,
                          63.0 / 2816.0,
                          231.0 / 13312.0,
                          143.0 / 10240.0,
                          6435.0 / 557056.0,
                          12155.0 / 1245184.0,
                          46189.0 / 5505024.0,
                          88179.0 / 12058624.0};
  T series = splat<T>(2.0 * c[11]);
  for (int k = 10; k >= 0; --k) series = madd(series, s2, splat<T>(2.0 * c[k]));
  V3<T> vector = with_sign(series, q.w) * V3<T>{q.x, q.y, q.z};
  constexpr double series_limit = 0.0873;  // sin^2(0.6 / 2)
  if constexpr (sizeof(T) == sizeof(double)) {
    if (!(s2 < series_limit)) vector = rotation_vector_any(q);
  } else if (__builtin_expect(!(horizontal_max(s2) < series_limit), 0)) {
    for (int l = 0; l < lane_count; ++l) {
      if (s2[l] < series_limit) continue;
      const V3<double> v = rotation_vector_any(Q4<double>{q.w[l], q.x[l], q.y[l], q.z[l]});
      vector.x[l] = v.x, vector.y[l] = v.y, vector.z[l] = v.z;
    }
  }
  return vector;
}

// --- to and from Eigen
// ------------------------------------------------------------------------------------------------
inline Q4<double> from_eigen(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline V3<double> from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Quaterniond to_eigen(const Q4<double>& q) { return {q.w, q.x, q.y, q.z}; }
inline Eigen::Vector3d to_eigen(const V3<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace ostium::core
