#pragma once
/// The matrix block of one element and its elimination. Internal to the solver.
///
/// With R rolls an element has 3 + R turns and 3 forces. The turns are stored as a 3 x 3 matrix, R vectors and an R x R
/// matrix, so that R = 0 costs nothing and known zeros are not multiplied.
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

/// Entries that belong to an element's rolls. R = 0 has none and costs nothing.
template <class X, int R>
struct Rolls {
  X of[R];
  X& operator[](int m) { return of[m]; }
  const X& operator[](int m) const { return of[m]; }
};
template <class X>
struct Rolls<X, 0> {
  X& operator[](int) { __builtin_unreachable(); }
  const X& operator[](int) const { __builtin_unreachable(); }
};

/// A turn with its rolls, or the torques on them.
template <class T, int R>
struct Turn {
  V3<T> v;
  Rolls<T, R> r;
};

/// Symmetric matrix over a turn and its rolls.
template <class T, int R>
struct Stiffness {
  S3<T> v;
  Rolls<V3<T>, R> vr;
  Rolls<Rolls<T, R>, R> rr;
};

/// Maps forces (3) to a turn and its rolls: G and its fill-in.
template <class T, int R>
struct Lever {
  M3<T> v;
  Rolls<V3<T>, R> r;
};

/// Coupling of an element's turns to those of the next.
template <class T, int R>
struct Coupling {
  M3<T> v;
  Rolls<V3<T>, R> vr;  ///< turn of this element, roll of the next
  Rolls<V3<T>, R> rv;  ///< roll of this element, turn of the next
  Rolls<T, R> rr;      ///< the same roll of both
};

/// Block row of one element: [K G; G^T -A] and its right-hand side.
template <class T, int R>
struct BlockRow {
  Stiffness<T, R> K;
  Lever<T, R> G;
  S3<T> A;
  Turn<T, R> torque;
  V3<T> gap;
};
template <class T, int R>
BlockRow<T, R> operator+(const BlockRow<T, R>& a, const BlockRow<T, R>& b) {
  BlockRow<T, R> out;
  out.K.v = a.K.v + b.K.v;
  out.G.v = {a.G.v.r0 + b.G.v.r0, a.G.v.r1 + b.G.v.r1, a.G.v.r2 + b.G.v.r2};
  out.A = a.A + b.A, out.torque.v = a.torque.v + b.torque.v, out.gap = a.gap + b.gap;
  for (int m = 0; m < R; ++m) {
    out.K.vr[m] = a.K.vr[m] + b.K.vr[m];
    for (int l = 0; l < R; ++l) out.K.rr[m][l] = a.K.rr[m][l] + b.K.rr[m][l];
    out.G.r[m] = a.G.r[m] + b.G.r[m];
    out.torque.r[m] = a.torque.r[m] + b.torque.r[m];
  }
  return out;
}

/// Smallest leading minor of a symmetric matrix: positive if and only if it is positive definite.
template <class T>
T least_minor(const S3<T>& s) {
  const T second = nmadd(s.xy, s.xy, s.xx * s.yy);
  const T third = madd(s.xx, nmadd(s.yz, s.yz, s.yy * s.zz),
                       madd(s.xy, nmadd(s.xy, s.zz, s.xz * s.yz), s.xz * nmadd(s.xz, s.yy, s.xy * s.yz)));
  return least(s.xx, least(second, third));
}

/// Inverse of the rolls' block.
template <class T>
Rolls<Rolls<T, 0>, 0> inverse(const Rolls<Rolls<T, 0>, 0>&, T&) {
  return {};
}
template <class T>
Rolls<Rolls<T, 1>, 1> inverse(const Rolls<Rolls<T, 1>, 1>& a, T& minor) {
  minor = least(minor, a[0][0]);
  Rolls<Rolls<T, 1>, 1> out;
  out[0][0] = 1.0 / a[0][0];
  return out;
}
template <class T>
Rolls<Rolls<T, 2>, 2> inverse(const Rolls<Rolls<T, 2>, 2>& a, T& minor) {
  const T determinant = nmadd(a[0][1], a[0][1], a[0][0] * a[1][1]), scale = 1.0 / determinant;
  minor = least(minor, least(a[0][0], determinant));
  Rolls<Rolls<T, 2>, 2> out;
  out[0][0] = scale * a[1][1], out[1][1] = scale * a[0][0];
  out[0][1] = out[1][0] = T{} - scale * a[0][1];
  return out;
}
template <class T>
Rolls<Rolls<T, 3>, 3> inverse(const Rolls<Rolls<T, 3>, 3>& a, T& minor) {
  const S3<T> s{a[0][0], a[0][1], a[0][2], a[1][1], a[1][2], a[2][2]}, i = inverse(s);
  minor = least(minor, least_minor(s));
  Rolls<Rolls<T, 3>, 3> out;
  out[0][0] = i.xx, out[1][1] = i.yy, out[2][2] = i.zz;
  out[0][1] = out[1][0] = i.xy, out[0][2] = out[2][0] = i.xz, out[1][2] = out[2][1] = i.yz;
  return out;
}

template <class T>
Rolls<Rolls<T, 4>, 4> inverse(const Rolls<Rolls<T, 4>, 4>& a, T& minor) {
  const S3<T> s{a[0][0], a[0][1], a[0][2], a[1][1], a[1][2], a[2][2]}, i = inverse(s);
  const V3<T> beside{a[0][3], a[1][3], a[2][3]}, lean = i * beside;
  const T rest = a[3][3] - dot(beside, lean), scale = 1.0 / rest;
  minor = least(minor, least(least_minor(s), rest));
  const T leans[3] = {lean.x, lean.y, lean.z};
  const T inner[3][3] = {{i.xx, i.xy, i.xz}, {i.xy, i.yy, i.yz}, {i.xz, i.yz, i.zz}};
  Rolls<Rolls<T, 4>, 4> out;
  for (int m = 0; m < 3; ++m) {
    for (int l = 0; l < 3; ++l) out[m][l] = madd(scale * leans[m], leans[l], inner[m][l]);
    out[m][3] = out[3][m] = T{} - scale * leans[m];
  }
  out[3][3] = scale;
  return out;
}

/// Inverse of S = K + G A^-1 G^T; `minor` becomes negative where S is not positive definite.
template <class T, int R>
Stiffness<T, R> inverse(const Stiffness<T, R>& S, T& minor) {
  const auto rr_inv = inverse(S.rr, minor);
  Rolls<V3<T>, R> lean;  // coupling of the turn to the rolls
  S3<T> rest = S.v;
  for (int m = 0; m < R; ++m) {
    lean[m] = V3<T>{};
    for (int l = 0; l < R; ++l) lean[m] = madd(rr_inv[m][l], S.vr[l], lean[m]);
    const V3<T>&a = lean[m], &b = S.vr[m];
    rest = {nmadd(a.x, b.x, rest.xx), nmadd(a.x, b.y, rest.xy), nmadd(a.x, b.z, rest.xz),
            nmadd(a.y, b.y, rest.yy), nmadd(a.y, b.z, rest.yz), nmadd(a.z, b.z, rest.zz)};
  }
  minor = least(minor, least_minor(rest));
  Stiffness<T, R> out;
  out.v = inverse(rest);
  for (int m = 0; m < R; ++m) {
    const V3<T> leaned = out.v * lean[m];
    out.vr[m] = V3<T>{} - leaned;
    for (int l = 0; l < R; ++l) out.rr[m][l] = madd(T{} + 1.0, dot(lean[l], leaned), rr_inv[m][l]);
  }
  return out;
}

template <class T, int R>
Turn<T, R> operator*(const Stiffness<T, R>& S, const Turn<T, R>& a) {
  Turn<T, R> out{S.v * a.v, {}};
  for (int m = 0; m < R; ++m) {
    out.v = madd(a.r[m], S.vr[m], out.v);
    out.r[m] = dot(S.vr[m], a.v);
    for (int l = 0; l < R; ++l) out.r[m] = madd(S.rr[m][l], a.r[l], out.r[m]);
  }
  return out;
}

/// m + a b^T
template <class T>
M3<T> outer_added(const V3<T>& a, const V3<T>& b, const M3<T>& m) {
  return {madd(a.x, b, m.r0), madd(a.y, b, m.r1), madd(a.z, b, m.r2)};
}
template <class T>
S3<T> symmetric_outer_added(const V3<T>& a, const V3<T>& b, const S3<T>& s) {
  return {madd(a.x, b.x, s.xx), madd(a.x, b.y, s.xy), madd(a.x, b.z, s.xz),
          madd(a.y, b.y, s.yy), madd(a.y, b.z, s.yz), madd(a.z, b.z, s.zz)};
}
template <class T>
M3<T> negative(const M3<T>& m) {
  return {V3<T>{} - m.r0, V3<T>{} - m.r1, V3<T>{} - m.r2};
}

template <class T, int R>
struct TridiagonalBlock {
  Stiffness<T, R> S_inv;  ///< inverse of K + G A^-1 G^T
  S3<T> A_inv;
  Lever<T, R> W;  ///< G A^-1
  Coupling<T, R> turn_coupling;
  S3<T> force_coupling;
  Turn<T, R> torque;
  V3<T> gap;
};

template <class T, int R>
struct EliminationHalt {
  BlockRow<T, R> carried{};  ///< Schur complement of the eliminated elements on the next
  T minor = splat<T>(1);     ///< smallest of theirs
};

/// D^-1 (torque, gap) for D = [K G; G^T -A].
template <class T, int R>
void apply_inverse(const Stiffness<T, R>& S_inv, const S3<T>& A_inv, const Lever<T, R>& W, Turn<T, R> torque,
                   const V3<T>& gap, Turn<T, R>& turn, V3<T>& force) {
  torque.v = torque.v + W.v * gap;
  for (int m = 0; m < R; ++m) torque.r[m] = torque.r[m] + dot(W.r[m], gap);
  turn = S_inv * torque;
  force = transpose_times(W.v, turn.v) - A_inv * gap;
  for (int m = 0; m < R; ++m) force = madd(turn.r[m], W.r[m], force);
}

template <class T, int R>
void factorise(const BlockRow<T, R>& r, S3<T>& A_inv, Lever<T, R>& W, Stiffness<T, R>& S_inv, T& minor) {
  A_inv = inverse(r.A);
  W.v = r.G.v * A_inv;
  Stiffness<T, R> S = r.K;
  S.v = S.v + symmetric_times_transpose(W.v, r.G.v);
  for (int m = 0; m < R; ++m) {
    W.r[m] = A_inv * r.G.r[m];
    S.vr[m] = S.vr[m] + W.v * r.G.r[m];
  }
  for (int m = 0; m < R; ++m)
    for (int l = 0; l < R; ++l) S.rr[m][l] = S.rr[m][l] + dot(W.r[m], r.G.r[l]);
  S_inv = inverse(S, minor);
}

/// Eliminates a row; returns its Schur complement on the next one, -E^T D^-1 E and -E^T D^-1 b with E =
/// diag(turn_coupling, force_coupling).
template <class T, int R>
BlockRow<T, R> eliminate(const BlockRow<T, R>& r, TridiagonalBlock<T, R>& block, T& minor) {
  factorise(r, block.A_inv, block.W, block.S_inv, minor);
  block.torque = r.torque, block.gap = r.gap;
  const Stiffness<T, R>& S = block.S_inv;
  const Lever<T, R>& W = block.W;
  const Coupling<T, R>& C = block.turn_coupling;
  const S3<T>& P = block.force_coupling;

  BlockRow<T, R> left;
  // C^T S C
  M3<T> SC = S.v * C.v;
  for (int m = 0; m < R; ++m) SC = outer_added(S.vr[m], C.rv[m], SC);
  left.K.v = symmetric_transpose_times(C.v, SC);
  Rolls<V3<T>, R> SC_rv;
  for (int m = 0; m < R; ++m) {
    SC_rv[m] = transpose_times(C.v, S.vr[m]);
    for (int l = 0; l < R; ++l) SC_rv[m] = madd(S.rr[m][l], C.rv[l], SC_rv[m]);
    left.K.v = symmetric_outer_added(C.rv[m], SC_rv[m], left.K.v);
  }
  left.K.v = S3<T>{} - left.K.v;
  for (int l = 0; l < R; ++l) {
    const V3<T> SC_vr = madd(C.rr[l], S.vr[l], S.v * C.vr[l]);
    V3<T> vr = transpose_times(C.v, SC_vr);
    for (int m = 0; m < R; ++m) {
      const T SC_rr = madd(S.rr[m][l], C.rr[l], dot(S.vr[m], C.vr[l]));
      vr = madd(SC_rr, C.rv[m], vr);
      left.K.rr[m][l] = -madd(C.rr[m], SC_rr, dot(C.vr[m], SC_vr));
    }
    left.K.vr[l] = V3<T>{} - vr;
  }

  // C^T S W P and P (W^T S W - A^-1) P
  const M3<T> WP = W.v * P;
  M3<T> SWP = S.v * WP;
  Rolls<V3<T>, R> WP_r;
  for (int m = 0; m < R; ++m) {
    WP_r[m] = P * W.r[m];
    SWP = outer_added(S.vr[m], WP_r[m], SWP);
  }
  const M3<T> AP{block.A_inv * V3<T>{P.xx, P.xy, P.xz}, block.A_inv * V3<T>{P.xy, P.yy, P.yz},
                 block.A_inv * V3<T>{P.xz, P.yz, P.zz}};
  const M3<T> P_rows{{P.xx, P.xy, P.xz}, {P.xy, P.yy, P.yz}, {P.xz, P.yz, P.zz}};
  left.A = symmetric_transpose_times(WP, SWP) - symmetric_times_transpose(P_rows, AP);
  M3<T> G = transpose_times(C.v, SWP);
  for (int m = 0; m < R; ++m) {
    V3<T> SWP_r = transpose_times(WP, S.vr[m]);
    for (int l = 0; l < R; ++l) SWP_r = madd(S.rr[m][l], WP_r[l], SWP_r);
    left.A = symmetric_outer_added(WP_r[m], SWP_r, left.A);
    G = outer_added(C.rv[m], SWP_r, G);
    left.G.r[m] = V3<T>{} - madd(C.rr[m], SWP_r, transpose_times(SWP, C.vr[m]));
  }
  left.G.v = negative(G);

  Turn<T, R> turn;
  V3<T> force;
  apply_inverse(S, block.A_inv, W, r.torque, r.gap, turn, force);
  V3<T> torque = transpose_times(C.v, turn.v);
  for (int m = 0; m < R; ++m) {
    torque = madd(turn.r[m], C.rv[m], torque);
    left.torque.r[m] = -madd(C.rr[m], turn.r[m], dot(C.vr[m], turn.v));
  }
  left.torque.v = V3<T>{} - torque;
  left.gap = V3<T>{} - P * force;
  return left;
}

}  // namespace ostium::core
