#include "core/solve/chain.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "core/tunables.h"

namespace ostium {

namespace {

constexpr int halves = 2;

int middle(const Chain& chain) { return (chain.first + chain.elements) / 2; }

/// Rows that belong to the rolls of an element. R = 0 has none, and costs nothing.
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

/// A turn and the rolls with it, or what works on them.
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

/// From forces (3) to a turn and its rolls: G and what fills it in.
template <class T, int R>
struct Lever {
  M3<T> v;
  Rolls<V3<T>, R> r;
};

/// How the turns of an element meet those of the next.
template <class T, int R>
struct Coupling {
  M3<T> v;
  Rolls<V3<T>, R> vr;  ///< turn here, roll there
  Rolls<V3<T>, R> rv;  ///< roll here, turn there
  Rolls<T, R> rr;      ///< the same roll
};

/// The way of one lane: from one end of one chain towards its middle. A lane with fewer elements starts later, and
/// idles until then.
struct Walk {
  const Chain* chain;
  bool forward;  ///< from the base
  int blocks;    ///< elements before the middle
  int wait;      ///< steps before the first

  int element(int t) const { return forward ? chain->first + t - wait : chain->elements - 1 - (t - wait); }
};

/// The entry, in a field's padding, of a regular block without coupling: K and the compliance behind are identities,
/// all else is zero.
/// There are two, as behind is ahead for lanes that walk the other way; `padded` leaves four entries for them.
int idle_entry(const Chain& chain, bool forward) { return chain.stiffness.stride() - (forward ? 4 : 2); }

void write_idle_entries(Chain& chain) {
  for (bool forward : {true, false}) {
    const int i = idle_entry(chain, forward);
    store6(chain.stiffness, i, identity3<double>());
    store6(chain.compliance, forward ? i : i + 1, identity3<double>());
    for (Roll& roll : chain.rolls) roll.stiffness.at(0)[i] = 1;
  }
}

/// Numbers that an elimination step reads: those of its element, of the node behind it and of the node ahead.
enum Number {
  at_K = 0,
  at_arm = 6,
  at_torque = 9,
  at_gap = 12,
  at_P_behind = 15,
  at_H = 21,
  at_m = 27,
  at_P_ahead = 30,
  numbers = 36
};
/// And of each roll.
enum RollNumber {
  at_k = 0,
  at_b = 1,
  at_beside = 4,
  at_roll_torque = 5,
  at_u = 6,
  at_w = 9,
  at_c = 12,
  roll_numbers = 13
};

/// The four lanes of a solve, and what they read at a step.
template <int R>
class Walks {
 public:
  Walks(const Chain& first, const Chain& second) {
    for (int l = 0; l < lane_count; ++l) {
      const bool forward = l % halves == 0;
      const Chain& chain = l < halves ? first : second;
      lanes_[l] = {&chain, forward, forward ? middle(chain) - chain.first : chain.elements - 1 - middle(chain), 0};
      direction_[l] = forward ? 1.0 : -1.0;
      steps_ = std::max(steps_, lanes_[l].blocks);
    }
    for (int l = 0; l < lane_count; ++l) {
      lanes_[l].wait = steps_ - lanes_[l].blocks;
      // Seen from an element, the node behind is its own when walking forward, the next one when walking back.
      const Chain& c = *lanes_[l].chain;
      const bool forward = lanes_[l].forward;
      const int behind = forward ? 0 : 1, ahead = 1 - behind;
      const auto from = [&](int number, const auto& field, int components, int shift) {
        for (int k = 0; k < components; ++k) source_[number + k][l] = field.at(k) + shift;
      };
      from(at_K, c.stiffness, 6, 0);
      from(at_arm, c.arm, 3, 0);
      from(at_torque, c.torque, 3, 0);
      from(at_gap, c.gap, 3, 0);
      from(at_P_behind, c.compliance, 6, behind);
      from(at_H, c.joint_stiffness, 6, ahead);
      from(at_m, c.joint_moment, 3, ahead);
      from(at_P_ahead, c.compliance, 6, ahead);
      for (int m = 0; m < R; ++m) {
        const Roll& roll = c.rolls[m];
        const int at = numbers + m * roll_numbers;
        from(at + at_k, roll.stiffness, 1, 0);
        from(at + at_b, roll.with_turn, 3, 0);
        from(at + at_beside, roll.beside, 1, 0);
        from(at + at_roll_torque, roll.torque, 1, 0);
        from(at + at_u, forward ? roll.ahead : roll.behind, 3, ahead);
        from(at + at_w, forward ? roll.behind : roll.ahead, 3, ahead);
        from(at + at_c, roll.both, 1, ahead);
      }
    }
  }

  int steps() const { return steps_; }
  Lanes direction() const { return direction_; }
  const Walk& lane(int l) const { return lanes_[l]; }

  /// Where the lanes are at step t.
  void move_to(int t) {
    for (int l = 0; l < lane_count; ++l)
      at_[l] = t < lanes_[l].wait ? idle_entry(*lanes_[l].chain, lanes_[l].forward) : lanes_[l].element(t);
  }
  Lanes read(int n) const {
    return Lanes{source_[n][0][at_[0]], source_[n][1][at_[1]], source_[n][2][at_[2]], source_[n][3][at_[3]]};
  }
  V3<Lanes> vector(int n) const { return {read(n), read(n + 1), read(n + 2)}; }
  S3<Lanes> symmetric(int n) const {
    return {read(n), read(n + 1), read(n + 2), read(n + 3), read(n + 4), read(n + 5)};
  }
  static int of_roll(int m, int number) { return numbers + m * roll_numbers + number; }

 private:
  Walk lanes_[lane_count];
  Lanes direction_{};
  int steps_ = 0;
  const double* source_[numbers + R * roll_numbers][lane_count];
  int at_[lane_count];
};

/// Block row of one element: [K G; G^T -A] and its right-hand side.
template <class T, int R>
struct Row {
  Stiffness<T, R> K;
  Lever<T, R> G;
  S3<T> A;
  Turn<T, R> torque;
  V3<T> gap;
};
template <class T, int R>
Row<T, R> operator+(const Row<T, R>& a, const Row<T, R>& b) {
  Row<T, R> out;
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

/// The row of an element by itself, from its numbers; read(number) and read_roll(roll, number) give one each.
template <class T, int R, class Read, class ReadRoll>
Row<T, R> row(const S3<T>& P_sum, Read&& read, ReadRoll&& read_roll) {
  const auto vector = [&](int n) -> V3<T> { return {read(n), read(n + 1), read(n + 2)}; };
  const V3<T> d = vector(at_arm), e = splat<T>(tunables::axial_give_per_N_m) * d;
  Row<T, R> out;
  out.K.v = {read(at_K), read(at_K + 1), read(at_K + 2), read(at_K + 3), read(at_K + 4), read(at_K + 5)};
  out.G.v = {{T{}, d.z, -d.y}, {-d.z, T{}, d.x}, {d.y, -d.x, T{}}};  // -[d]x
  out.A = {madd(e.x, d.x, P_sum.xx), madd(e.x, d.y, P_sum.xy), madd(e.x, d.z, P_sum.xz),
           madd(e.y, d.y, P_sum.yy), madd(e.y, d.z, P_sum.yz), madd(e.z, d.z, P_sum.zz)};
  out.torque.v = vector(at_torque), out.gap = vector(at_gap);
  for (int m = 0; m < R; ++m) {
    out.K.vr[m] = {read_roll(m, at_b), read_roll(m, at_b + 1), read_roll(m, at_b + 2)};
    for (int l = 0; l < R; ++l) out.K.rr[m][l] = T{};
    out.G.r[m] = V3<T>{};
    out.torque.r[m] = read_roll(m, at_roll_torque);
  }
  for (int m = 0; m < R; ++m) {
    out.K.rr[m][m] = read_roll(m, at_k);
    if (m > 0) out.K.rr[m][m - 1] = out.K.rr[m - 1][m] = read_roll(m, at_beside);
  }
  return out;
}

/// Positive where a symmetric matrix is positive definite, else not: the least of its leading minors.
template <class T>
T least_minor(const S3<T>& s) {
  const T second = nmadd(s.xy, s.xy, s.xx * s.yy);
  const T third = madd(s.xx, nmadd(s.yz, s.yz, s.yy * s.zz),
                       madd(s.xy, nmadd(s.xy, s.zz, s.xz * s.yz), s.xz * nmadd(s.xz, s.yy, s.xy * s.yz)));
  return least(s.xx, least(second, third));
}

/// Inverse of the rolls' part.
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

/// Inverse of K + G A^-1 G^T = S; `minor` becomes negative where S is not positive definite.
template <class T, int R>
Stiffness<T, R> inverse(const Stiffness<T, R>& S, T& minor) {
  const auto rr_inv = inverse(S.rr, minor);
  Rolls<V3<T>, R> lean;  // of the turn on the rolls
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

/// row + a b^T
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

}  // namespace

template <int R>
struct ChainBlock {
  Stiffness<Lanes, R> S_inv;  ///< inverse of K + G A^-1 G^T
  S3<Lanes> A_inv;
  Lever<Lanes, R> W;  ///< G A^-1
  Coupling<Lanes, R> turn_coupling;
  S3<Lanes> force_coupling;
  Turn<Lanes, R> torque;
  V3<Lanes> gap;
};

namespace {

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
void factorise(const Row<T, R>& r, S3<T>& A_inv, Lever<T, R>& W, Stiffness<T, R>& S_inv, T& minor) {
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

/// Eliminates a row; returns what it leaves on the next one, -E^T D^-1 E and -E^T D^-1 b with
/// E = diag(turn_coupling, force_coupling).
template <int R>
Row<Lanes, R> eliminate(const Row<Lanes, R>& r, ChainBlock<R>& block, Lanes& minor) {
  factorise(r, block.A_inv, block.W, block.S_inv, minor);
  block.torque = r.torque, block.gap = r.gap;
  const Stiffness<Lanes, R>& S = block.S_inv;
  const Lever<Lanes, R>& W = block.W;
  const Coupling<Lanes, R>& C = block.turn_coupling;
  const S3<Lanes>& P = block.force_coupling;

  Row<Lanes, R> left;
  // C^T S C
  M3<Lanes> SC = S.v * C.v;
  for (int m = 0; m < R; ++m) SC = outer_added(S.vr[m], C.rv[m], SC);
  left.K.v = symmetric_transpose_times(C.v, SC);
  Rolls<V3<Lanes>, R> SC_rv;
  for (int m = 0; m < R; ++m) {
    SC_rv[m] = transpose_times(C.v, S.vr[m]);
    for (int l = 0; l < R; ++l) SC_rv[m] = madd(S.rr[m][l], C.rv[l], SC_rv[m]);
    left.K.v = symmetric_outer_added(C.rv[m], SC_rv[m], left.K.v);
  }
  left.K.v = S3<Lanes>{} - left.K.v;
  for (int l = 0; l < R; ++l) {
    const V3<Lanes> SC_vr = madd(C.rr[l], S.vr[l], S.v * C.vr[l]);
    V3<Lanes> vr = transpose_times(C.v, SC_vr);
    for (int m = 0; m < R; ++m) {
      const Lanes SC_rr = madd(S.rr[m][l], C.rr[l], dot(S.vr[m], C.vr[l]));
      vr = madd(SC_rr, C.rv[m], vr);
      left.K.rr[m][l] = -madd(C.rr[m], SC_rr, dot(C.vr[m], SC_vr));
    }
    left.K.vr[l] = V3<Lanes>{} - vr;
  }

  // C^T S W P and P (W^T S W - A^-1) P
  const M3<Lanes> WP = W.v * P;
  M3<Lanes> SWP = S.v * WP;
  Rolls<V3<Lanes>, R> WP_r;
  for (int m = 0; m < R; ++m) {
    WP_r[m] = P * W.r[m];
    SWP = outer_added(S.vr[m], WP_r[m], SWP);
  }
  const M3<Lanes> AP{block.A_inv * V3<Lanes>{P.xx, P.xy, P.xz}, block.A_inv * V3<Lanes>{P.xy, P.yy, P.yz},
                     block.A_inv * V3<Lanes>{P.xz, P.yz, P.zz}};
  const M3<Lanes> P_rows{{P.xx, P.xy, P.xz}, {P.xy, P.yy, P.yz}, {P.xz, P.yz, P.zz}};
  left.A = symmetric_transpose_times(WP, SWP) - symmetric_times_transpose(P_rows, AP);
  M3<Lanes> G = transpose_times(C.v, SWP);
  for (int m = 0; m < R; ++m) {
    V3<Lanes> SWP_r = transpose_times(WP, S.vr[m]);
    for (int l = 0; l < R; ++l) SWP_r = madd(S.rr[m][l], WP_r[l], SWP_r);
    left.A = symmetric_outer_added(WP_r[m], SWP_r, left.A);
    G = outer_added(C.rv[m], SWP_r, G);
    left.G.r[m] = V3<Lanes>{} - madd(C.rr[m], SWP_r, transpose_times(SWP, C.vr[m]));
  }
  left.G.v = negative(G);

  Turn<Lanes, R> turn;
  V3<Lanes> force;
  apply_inverse(S, block.A_inv, W, r.torque, r.gap, turn, force);
  V3<Lanes> torque = transpose_times(C.v, turn.v);
  for (int m = 0; m < R; ++m) {
    torque = madd(turn.r[m], C.rv[m], torque);
    left.torque.r[m] = -madd(C.rr[m], turn.r[m], dot(C.vr[m], turn.v));
  }
  left.torque.v = V3<Lanes>{} - torque;
  left.gap = V3<Lanes>{} - P * force;
  return left;
}

V3<double> lane_of(const V3<Lanes>& a, int l) { return {a.x[l], a.y[l], a.z[l]}; }
S3<double> lane_of(const S3<Lanes>& a, int l) { return {a.xx[l], a.xy[l], a.xz[l], a.yy[l], a.yz[l], a.zz[l]}; }
M3<double> lane_of(const M3<Lanes>& a, int l) { return {lane_of(a.r0, l), lane_of(a.r1, l), lane_of(a.r2, l)}; }
template <int R>
Row<double, R> lane_of(const Row<Lanes, R>& a, int l) {
  Row<double, R> out;
  out.K.v = lane_of(a.K.v, l), out.G.v = lane_of(a.G.v, l), out.A = lane_of(a.A, l);
  out.torque.v = lane_of(a.torque.v, l), out.gap = lane_of(a.gap, l);
  for (int m = 0; m < R; ++m) {
    out.K.vr[m] = lane_of(a.K.vr[m], l), out.G.r[m] = lane_of(a.G.r[m], l);
    out.torque.r[m] = a.torque.r[m][l];
    for (int k = 0; k < R; ++k) out.K.rr[m][k] = a.K.rr[m][k][l];
  }
  return out;
}
void set_lane(V3<Lanes>& a, int l, const V3<double>& b) { a.x[l] = b.x, a.y[l] = b.y, a.z[l] = b.z; }
void set_lane(S3<Lanes>& a, int l, const S3<double>& b) {
  a.xx[l] = b.xx, a.xy[l] = b.xy, a.xz[l] = b.xz, a.yy[l] = b.yy, a.yz[l] = b.yz, a.zz[l] = b.zz;
}

template <int R>
Row<double, R> middle_row(const Chain& c) {
  const int m = middle(c);
  const double* from[at_P_behind];
  const auto take = [&](int number, const auto& field, int components) {
    for (int k = 0; k < components; ++k) from[number + k] = field.at(k) + m;
  };
  take(at_K, c.stiffness, 6), take(at_arm, c.arm, 3), take(at_torque, c.torque, 3), take(at_gap, c.gap, 3);
  const auto of_roll = [&](int roll, int number) {
    const Roll& r = c.rolls[roll];
    return number == at_k             ? r.stiffness.at(0)[m]
           : number == at_beside      ? r.beside.at(0)[m]
           : number == at_roll_torque ? r.torque.at(0)[m]
                                      : r.with_turn.at(number - at_b)[m];
  };
  return row<double, R>(
      load6<double>(c.compliance, m) + load6<double>(c.compliance, m + 1), [&](int n) { return *from[n]; }, of_roll);
}

/// Towards the middle: fills the blocks, returns what all lanes leave on their middle element.
template <int R>
[[gnu::flatten]] Row<Lanes, R> eliminate_halves(Walks<R>& walks, std::vector<ChainBlock<R>>& blocks, Lanes& minor) {
  const Lanes half = 0.5 * walks.direction();
  Row<Lanes, R> carried{};
  for (int t = 0; t < walks.steps(); ++t) {
    walks.move_to(t);
    ChainBlock<R>& block = blocks[t];
    const S3<Lanes> H = walks.symmetric(at_H);
    const V3<Lanes> m = half * walks.vector(at_m);
    Coupling<Lanes, R>& C = block.turn_coupling;
    C.v = {{-H.xx, -H.xy - m.z, m.y - H.xz}, {m.z - H.xy, -H.yy, -H.yz - m.x}, {-H.xz - m.y, m.x - H.yz, -H.zz}};
    for (int k = 0; k < R; ++k) {
      C.vr[k] = walks.vector(walks.of_roll(k, at_u)), C.rv[k] = walks.vector(walks.of_roll(k, at_w));
      C.rr[k] = walks.read(walks.of_roll(k, at_c));
    }
    block.force_coupling = walks.symmetric(at_P_ahead);
    const Row<Lanes, R> own = row<Lanes, R>(
        walks.symmetric(at_P_behind) + block.force_coupling, [&](int n) { return walks.read(n); },
        [&](int k, int n) { return walks.read(walks.of_roll(k, n)); });
    carried = eliminate(own + carried, block, minor);
  }
  return carried;
}

template <int R>
void store(Chain& chain, int j, const V3<double>& turn, const Rolls<double, R>& rolls, const V3<double>& force) {
  store3(chain.turn, j, turn), store3(chain.force, j, force);
  for (int m = 0; m < R; ++m) chain.rolls[m].turn.at(0)[j] = rolls[m];
}

/// Solves a chain's middle element, and hands its solution to both lanes; false if the matrix is not definite.
template <int R>
bool solve_middle(Chain& chain, int front, const Row<Lanes, R>& carried, const Lanes& minor, ChainBlock<R>& block,
                  Turn<Lanes, R>& turn, V3<Lanes>& force) {
  const Row<double, R> r = middle_row<R>(chain) + lane_of(carried, front) + lane_of(carried, front + 1);
  S3<double> A_inv;
  Lever<double, R> W;
  Stiffness<double, R> S_inv;
  double own_minor = 1;
  factorise(r, A_inv, W, S_inv, own_minor);
  Turn<double, R> phi;
  V3<double> n;
  apply_inverse(S_inv, A_inv, W, r.torque, r.gap, phi, n);
  store<R>(chain, middle(chain), phi.v, phi.r, n);
  for (int l : {front, front + 1}) {
    set_lane(turn.v, l, phi.v), set_lane(force, l, n);
    for (int m = 0; m < R; ++m) turn.r[m][l] = phi.r[m];
    set_lane(block.S_inv.v, l, S_inv.v), set_lane(block.A_inv, l, A_inv);
  }
  return minor[front] > 0 && minor[front + 1] > 0 && own_minor > 0;
}

/// From the middle back to the ends.
template <int R>
[[gnu::flatten]] void substitute_back(const Walks<R>& walks, const std::vector<ChainBlock<R>>& blocks, Chain& first,
                                      Chain* second, Turn<Lanes, R> turn, V3<Lanes> force) {
  const int lanes = second ? lane_count : halves;
  for (int t = walks.steps() - 1; t >= 0; --t) {
    const ChainBlock<R>& b = blocks[t];
    const Coupling<Lanes, R>& C = b.turn_coupling;
    Turn<Lanes, R> torque = b.torque;
    torque.v = torque.v - C.v * turn.v;
    for (int m = 0; m < R; ++m) {
      torque.v = torque.v - turn.r[m] * C.vr[m];
      torque.r[m] = torque.r[m] - madd(C.rr[m], turn.r[m], dot(C.rv[m], turn.v));
    }
    Turn<Lanes, R> next;
    apply_inverse(b.S_inv, b.A_inv, b.W, torque, b.gap - b.force_coupling * force, next, force);
    turn = next;
    for (int l = 0; l < lanes; ++l) {
      if (t < walks.lane(l).wait) continue;
      Rolls<double, R> rolls;
      for (int m = 0; m < R; ++m) rolls[m] = turn.r[m][l];
      store<R>(l < halves ? first : *second, walks.lane(l).element(t), lane_of(turn.v, l), rolls, lane_of(force, l));
    }
  }
}

/// Number of negative eigenvalues of a symmetric 3 x 3 matrix, by the signs of its pivots.
int negatives(const S3<double>& s) {
  const double first = s.xx, second = s.yy - s.xy * s.xy / s.xx;
  const double yz = s.yz - s.xy * s.xz / s.xx;
  const double third = s.zz - s.xz * s.xz / s.xx - yz * yz / second;
  return (first < 0) + (second < 0) + (third < 0);
}

template <int R>
void solve_with(Chain& first, Chain* second, ChainFactors& factors) {
  std::vector<ChainBlock<R>>& blocks = factors.blocks<R>();
  assert(static_cast<int>(blocks.size()) > std::max(first.elements, second ? second->elements : 0) / 2);
  Walks<R> walks(first, second ? *second : first);
  Lanes minor = splat<Lanes>(1);
  const Row<Lanes, R> carried = eliminate_halves(walks, blocks, minor);

  Turn<Lanes, R> turn{};
  V3<Lanes> force{};
  ChainBlock<R>& middle_block = blocks[walks.steps()];
  first.definite = solve_middle(first, 0, carried, minor, middle_block, turn, force);
  if (second) second->definite = solve_middle(*second, halves, carried, minor, middle_block, turn, force);
  substitute_back(walks, blocks, first, second, turn, force);
}

}  // namespace

struct ChainFactors::Blocks {
  std::tuple<std::vector<ChainBlock<0>>, std::vector<ChainBlock<1>>, std::vector<ChainBlock<2>>,
             std::vector<ChainBlock<3>>>
      by_rolls;
};

ChainFactors::ChainFactors() : blocks_(std::make_unique<Blocks>()) {}
ChainFactors::~ChainFactors() = default;
ChainFactors::ChainFactors(ChainFactors&&) noexcept = default;
ChainFactors& ChainFactors::operator=(ChainFactors&&) noexcept = default;

template <int R>
std::vector<ChainBlock<R>>& ChainFactors::blocks() {
  return std::get<R>(blocks_->by_rolls);
}
template <int R>
const std::vector<ChainBlock<R>>& ChainFactors::blocks() const {
  return std::get<R>(blocks_->by_rolls);
}

void ChainFactors::resize(int elements, int rolls) {
  const auto make_room = [&](auto& blocks) { blocks.resize(std::max<std::size_t>(blocks.size(), elements / 2 + 1)); };
  rolls == 0   ? make_room(blocks<0>())
  : rolls == 1 ? make_room(blocks<1>())
  : rolls == 2 ? make_room(blocks<2>())
               : make_room(blocks<3>());
}

Roll::Roll(int elements)
    : stiffness(elements + 1),
      beside(elements + 1),
      with_turn(elements + 1),
      ahead(elements + 1),
      behind(elements + 1),
      both(elements + 1),
      torque(elements + 1),
      turn(elements + 1) {}

Chain::Chain(int elements, int rolls)
    : elements(elements),
      stiffness(elements + 1),
      joint_stiffness(elements + 1),
      joint_moment(elements + 1),
      arm(elements + 1),
      compliance(elements + 1),
      torque(elements + 1),
      gap(elements + 1),
      rolls(rolls, Roll(elements)),
      roll_count(rolls),
      turn(elements + 1),
      force(elements + 1) {
  write_idle_entries(*this);
}

void solve(Chain& first, Chain* second, ChainFactors& factors) {
  assert(!second || second->roll_count == first.roll_count);
  switch (first.roll_count) {
    case 0:
      return solve_with<0>(first, second, factors);
    case 1:
      return solve_with<1>(first, second, factors);
    case 2:
      return solve_with<2>(first, second, factors);
    default:
      return solve_with<3>(first, second, factors);
  }
}

int negative_pivots(const Chain& chain, const ChainFactors& factors) {
  assert(chain.roll_count == 0);
  // Inertia of the whole system: it has 3 N negative eigenvalues for its 3 N constraint forces; more are unstable.
  const Walks<0> walks(chain, chain);
  int negative = 0;
  const auto count = [&](int t, int l) {
    const ChainBlock<0>& block = factors.blocks<0>()[t];
    negative += negatives(lane_of(block.S_inv.v, l)) + 3 - negatives(lane_of(block.A_inv, l));
  };
  for (int t = 0; t < walks.steps(); ++t)
    for (int l = 0; l < halves; ++l)
      if (t >= walks.lane(l).wait) count(t, l);
  count(walks.steps(), 0);
  return negative - 3 * (chain.elements - chain.first);
}

}  // namespace ostium
