#pragma once
/// One joint of a rod, linearised about its frames.
#include "core/material/moment_response.h"
#include "core/math/rotation.h"

namespace ostium::core {

/// A joint between frames a (proximal) and b (distal).
///
/// Its strain is the rotation vector theta of R_a^T R_b over the cell's length, i.e. the mean Darboux vector. A turn
/// phi of the frames changes it by d(theta) = J^-1(theta) R_a^T (phi_b - phi_a), with the inverse left Jacobian of
/// SO(3)
///   J^-1 = I - [theta]x / 2 + c [theta]x^2,  c = 1/12 + theta^2 / 720 + ...
/// (Sola, Deray, Atchuthan 2018, eq. 146), so the world-frame moment is R_a J^-T m. Its tangent is taken at the mid
/// frame; since the moment turns with the mean of both frames, there is the term [m]x / 2 that `BlockTridiagonal`
/// couples by.
template <class T>
struct Joint {
  S3<T> stiffness;  ///< world frame, N m/rad
  V3<T> moment;     ///< world frame, N m
  V3<T> strain;     ///< material frame, 1/m
};

template <class T, class Law>
Joint<T> joint(const Law& law, const V3<T>& rest, T length, const Q4<T>& a, Q4<T> b, int i, T damping_s, T rate_scale,
               const V3<T>& strain_offset) {
  const Q4<T> relative = conjugate(a) * b;
  const V3<T> theta = rotation_vector(relative);
  const T per_length = 1.0 / length;
  Joint<T> out;
  out.strain = per_length * theta;

  auto [m, C] = law.template operator()<T>(out.strain - rest, i);
  // Kelvin-Voigt: C (u + tau du/dt), with du/dt = rate_scale u - strain_offset (BDF2).
  m = madd(damping_s, C * (rate_scale * out.strain - strain_offset), m);
  C = madd(damping_s, rate_scale, T{} + 1.0) * C;

  const T theta2 = dot(theta, theta);
  const T c = madd(theta2, T{} + 1.0 / 720.0, T{} + 1.0 / 12.0);
  const V3<T> tm = cross(theta, m);
  out.moment = matrix(a) * (m + madd(T{} + 0.5, tm, c * cross(theta, tm)));

  const T sign = with_sign(T{} + 1.0, relative.w);  // q and -q are the same rotation
  const M3<T> R =
      matrix(normalised(Q4<T>{madd(sign, b.w, a.w), madd(sign, b.x, a.x), madd(sign, b.y, a.y), madd(sign, b.z, a.z)}));
  out.stiffness = per_length * symmetric_times_transpose(R * C, R);
  return out;
}

}  // namespace ostium::core
