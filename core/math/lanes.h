#pragma once
/// Small dense algebra over a scalar type T that is `double`, `Lanes` (four doubles in one AVX2 register) or `Pair`
/// (two, in half of one). The rod kernels are templates on T and process four joints, or both halves of a chain, at a
/// time.
///
/// Fused multiply-adds are explicit (`madd`), never left to the compiler, so results do not depend on inlining.
/// Everything here is pure, branch-free and thread-safe.
#include <immintrin.h>

#include <cmath>

namespace ostium::core {

using Lanes = double __attribute__((vector_size(32)));
inline constexpr int lane_count = 4;
using Pair = double __attribute__((vector_size(16)));

inline double madd(double a, double b, double c) { return std::fma(a, b, c); }     ///< a b + c
inline double nmadd(double a, double b, double c) { return std::fma(-a, b, c); }   ///< c - a b
inline Lanes madd(Lanes a, Lanes b, Lanes c) { return _mm256_fmadd_pd(a, b, c); }  ///< a b + c
inline Lanes nmadd(Lanes a, Lanes b, Lanes c) { return _mm256_fnmadd_pd(a, b, c); }
inline Pair madd(Pair a, Pair b, Pair c) { return _mm_fmadd_pd(a, b, c); }
inline Pair nmadd(Pair a, Pair b, Pair c) { return _mm_fnmadd_pd(a, b, c); }

inline double square_root(double a) { return std::sqrt(a); }
inline Lanes square_root(Lanes a) { return _mm256_sqrt_pd(a); }
/// |a| with the sign of b.
inline double with_sign(double a, double b) { return std::copysign(a, b); }
inline Lanes with_sign(Lanes a, Lanes b) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return _mm256_or_pd(_mm256_andnot_pd(sign, a), _mm256_and_pd(sign, b));
}
inline double largest(double a, double b) { return a > b ? a : b; }
inline Lanes largest(Lanes a, Lanes b) { return _mm256_max_pd(a, b); }
inline double least(double a, double b) { return a < b ? a : b; }
inline Lanes least(Lanes a, Lanes b) { return _mm256_min_pd(a, b); }
inline Pair least(Pair a, Pair b) { return _mm_min_pd(a, b); }
inline double horizontal_max(double a) { return a; }
inline double horizontal_max(Lanes a) { return largest(largest(a[0], a[1]), largest(a[2], a[3])); }

template <class T>
T load(const double* p);
template <>
inline double load<double>(const double* p) {
  return *p;
}
template <>
inline Lanes load<Lanes>(const double* p) {
  return _mm256_loadu_pd(p);
}
inline void store(double* p, double a) { *p = a; }
inline void store(double* p, Lanes a) { _mm256_storeu_pd(p, a); }
inline void store(float* p, double a) { *p = static_cast<float>(a); }
inline void store(float* p, Lanes a) { _mm_storeu_ps(p, _mm256_cvtpd_ps(a)); }

template <class T>
T splat(double a) {
  return T{} + a;
}

/// Vector.
template <class T>
struct V3 {
  T x{}, y{}, z{};
};
/// Symmetric matrix.
template <class T>
struct S3 {
  T xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};
/// General matrix, by rows.
template <class T>
struct M3 {
  V3<T> r0, r1, r2;
};
/// Unit quaternion w + (x, y, z).
template <class T>
struct Q4 {
  T w{}, x{}, y{}, z{};
};

// --- vectors ---------------------------------------------------------------------------------------------------------
template <class T>
[[gnu::always_inline]] inline V3<T> operator+(const V3<T>& a, const V3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
[[gnu::always_inline]] inline V3<T> operator-(const V3<T>& a, const V3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
[[gnu::always_inline]] inline V3<T> operator*(T s, const V3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
[[gnu::always_inline]] inline T dot(const V3<T>& a, const V3<T>& b) {
  return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
}
template <class T>
[[gnu::always_inline]] inline V3<T> cross(const V3<T>& a, const V3<T>& b) {
  return {nmadd(a.z, b.y, a.y * b.z), nmadd(a.x, b.z, a.z * b.x), nmadd(a.y, b.x, a.x * b.y)};
}
/// s a + b
template <class T>
[[gnu::always_inline]] inline V3<T> madd(T s, const V3<T>& a, const V3<T>& b) {
  return {madd(s, a.x, b.x), madd(s, a.y, b.y), madd(s, a.z, b.z)};
}

// --- matrices --------------------------------------------------------------------------------------------------------
template <class T>
inline S3<T> operator+(const S3<T>& a, const S3<T>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
template <class T>
inline S3<T> operator-(const S3<T>& a, const S3<T>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}
template <class T>
inline S3<T> operator*(T s, const S3<T>& a) {
  return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
}
template <class T>
inline V3<T> operator*(const S3<T>& s, const V3<T>& a) {
  return {madd(s.xx, a.x, madd(s.xy, a.y, s.xz * a.z)), madd(s.xy, a.x, madd(s.yy, a.y, s.yz * a.z)),
          madd(s.xz, a.x, madd(s.yz, a.y, s.zz * a.z))};
}
template <class T>
inline V3<T> operator*(const M3<T>& m, const V3<T>& a) {
  return {dot(m.r0, a), dot(m.r1, a), dot(m.r2, a)};
}
/// transpose(m) a
template <class T>
inline V3<T> transpose_times(const M3<T>& m, const V3<T>& a) {
  return madd(a.x, m.r0, madd(a.y, m.r1, a.z * m.r2));
}
template <class T>
inline M3<T> operator*(const M3<T>& m, const S3<T>& s) {
  return {s * m.r0, s * m.r1, s * m.r2};
}
template <class T>
inline M3<T> operator*(const S3<T>& s, const M3<T>& m) {
  return {madd(s.xx, m.r0, madd(s.xy, m.r1, s.xz * m.r2)), madd(s.xy, m.r0, madd(s.yy, m.r1, s.yz * m.r2)),
          madd(s.xz, m.r0, madd(s.yz, m.r1, s.zz * m.r2))};
}
/// transpose(a) b
template <class T>
inline M3<T> transpose_times(const M3<T>& a, const M3<T>& b) {
  return {madd(a.r0.x, b.r0, madd(a.r1.x, b.r1, a.r2.x * b.r2)), madd(a.r0.y, b.r0, madd(a.r1.y, b.r1, a.r2.y * b.r2)),
          madd(a.r0.z, b.r0, madd(a.r1.z, b.r1, a.r2.z * b.r2))};
}
/// transpose(a) b where the product is known to be symmetric.
template <class T>
inline S3<T> symmetric_transpose_times(const M3<T>& a, const M3<T>& b) {
  const auto entry = [](T a0, T b0, T a1, T b1, T a2, T b2) { return madd(a0, b0, madd(a1, b1, a2 * b2)); };
  return {entry(a.r0.x, b.r0.x, a.r1.x, b.r1.x, a.r2.x, b.r2.x), entry(a.r0.x, b.r0.y, a.r1.x, b.r1.y, a.r2.x, b.r2.y),
          entry(a.r0.x, b.r0.z, a.r1.x, b.r1.z, a.r2.x, b.r2.z), entry(a.r0.y, b.r0.y, a.r1.y, b.r1.y, a.r2.y, b.r2.y),
          entry(a.r0.y, b.r0.z, a.r1.y, b.r1.z, a.r2.y, b.r2.z), entry(a.r0.z, b.r0.z, a.r1.z, b.r1.z, a.r2.z, b.r2.z)};
}
/// a transpose(b) where the product is known to be symmetric.
template <class T>
inline S3<T> symmetric_times_transpose(const M3<T>& a, const M3<T>& b) {
  return {dot(a.r0, b.r0), dot(a.r0, b.r1), dot(a.r0, b.r2), dot(a.r1, b.r1), dot(a.r1, b.r2), dot(a.r2, b.r2)};
}
/// Inverse by cofactors; `s` must not be singular.
template <class T>
inline S3<T> inverse(const S3<T>& s) {
  const T cxx = nmadd(s.yz, s.yz, s.yy * s.zz), cxy = nmadd(s.xy, s.zz, s.xz * s.yz),
          cxz = nmadd(s.xz, s.yy, s.xy * s.yz);
  const T scale = 1.0 / madd(s.xx, cxx, madd(s.xy, cxy, s.xz * cxz));
  return {scale * cxx,
          scale * cxy,
          scale * cxz,
          scale * nmadd(s.xz, s.xz, s.xx * s.zz),
          scale * nmadd(s.xx, s.yz, s.xy * s.xz),
          scale * nmadd(s.xy, s.xy, s.xx * s.yy)};
}
template <class T>
inline S3<T> identity3() {
  return {splat<T>(1), T{}, T{}, splat<T>(1), T{}, splat<T>(1)};
}

}  // namespace ostium::core
