#pragma once
/// Elimination along one chain or two, from the ends towards the middle, and the way back. Internal to the solver.
#include <algorithm>
#include <type_traits>

#include "core/base/tolerances.h"
#include "core/solver/block.h"
#include "core/solver/block_tridiagonal.h"
#include "core/solver/block_tridiagonal_walks.h"
#include "core/solver/tridiagonal_factors.h"

namespace ostium::core {

/// An element's own row; read(number) and read_roll(roll, number) return its entries.
template <class T, int R, class Read, class ReadRoll>
BlockRow<T, R> row(const S3<T>& P_sum, Read&& read, ReadRoll&& read_roll) {
  const auto vector = [&](int n) -> V3<T> { return {read(n), read(n + 1), read(n + 2)}; };
  const V3<T> d = vector(at_arm), e = splat<T>(tolerances::axial_give_per_N_m) * d;
  BlockRow<T, R> out;
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

template <class T>
V3<double> lane_of(const V3<T>& a, int l) {
  return {a.x[l], a.y[l], a.z[l]};
}
template <class T>
S3<double> lane_of(const S3<T>& a, int l) {
  return {a.xx[l], a.xy[l], a.xz[l], a.yy[l], a.yz[l], a.zz[l]};
}
template <class T>
M3<double> lane_of(const M3<T>& a, int l) {
  return {lane_of(a.r0, l), lane_of(a.r1, l), lane_of(a.r2, l)};
}
template <class T, int R>
BlockRow<double, R> lane_of(const BlockRow<T, R>& a, int l) {
  BlockRow<double, R> out;
  out.K.v = lane_of(a.K.v, l), out.G.v = lane_of(a.G.v, l), out.A = lane_of(a.A, l);
  out.torque.v = lane_of(a.torque.v, l), out.gap = lane_of(a.gap, l);
  for (int m = 0; m < R; ++m) {
    out.K.vr[m] = lane_of(a.K.vr[m], l), out.G.r[m] = lane_of(a.G.r[m], l);
    out.torque.r[m] = a.torque.r[m][l];
    for (int k = 0; k < R; ++k) out.K.rr[m][k] = a.K.rr[m][k][l];
  }
  return out;
}
template <class T>
void set_lane(V3<T>& a, int l, const V3<double>& b) {
  a.x[l] = b.x, a.y[l] = b.y, a.z[l] = b.z;
}
template <class T>
void set_lane(S3<T>& a, int l, const S3<double>& b) {
  a.xx[l] = b.xx, a.xy[l] = b.xy, a.xz[l] = b.xz, a.yy[l] = b.yy, a.yz[l] = b.yz, a.zz[l] = b.zz;
}

template <int R>
BlockRow<double, R> middle_row(const BlockTridiagonal& c) {
  const int m = c.meets_at;
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

template <class T, int R>
void set_lane(BlockRow<T, R>& a, int l, const BlockRow<double, R>& b) {
  set_lane(a.K.v, l, b.K.v), set_lane(a.A, l, b.A);
  set_lane(a.G.v.r0, l, b.G.v.r0), set_lane(a.G.v.r1, l, b.G.v.r1), set_lane(a.G.v.r2, l, b.G.v.r2);
  set_lane(a.torque.v, l, b.torque.v), set_lane(a.gap, l, b.gap);
  for (int m = 0; m < R; ++m) {
    set_lane(a.K.vr[m], l, b.K.vr[m]), set_lane(a.G.r[m], l, b.G.r[m]);
    a.torque.r[m][l] = b.torque.r[m];
    for (int k = 0; k < R; ++k) a.K.rr[m][k][l] = b.K.rr[m][k];
  }
}

/// What the branches of a fork add to the row of the last element.
template <int R>
BlockRow<double, R> row_of_branches(const BlockTridiagonal& chain) {
  const TipRow& tip = chain.branches;
  BlockRow<double, R> out;
  out.K.v = tip.K, out.G.v = tip.G, out.A = tip.A, out.torque.v = tip.torque, out.gap = tip.gap;
  for (int m = 0; m < R; ++m) {
    out.K.vr[m] = tip.with_roll[m], out.G.r[m] = tip.roll_G[m];
    out.torque.r[m] = tip.roll_torque[m];
    for (int k = 0; k < R; ++k) out.K.rr[m][k] = tip.rolls[m][k];
  }
  return out;
}

/// Lanes that run backward have eliminated nothing yet.
template <class T, int R>
void restart_backward(EliminationHalt<T, R>& halt) {
  for (int l = 1; l < Walks<T, R>::lanes; l += halves) {
    set_lane(halt.carried, l, BlockRow<double, R>{});
    halt.minor[l] = 1;
  }
}

/// Where an elimination begins: from scratch, or where nothing has changed before.
struct Resume {
  int step = 0;
  bool backward_anew = false;  ///< lanes that run backward have not begun there
};

/// Eliminates towards the meeting point from a step, or from the last halt before it, filling the blocks. Returns the
/// Schur complements of all lanes on the elements where they meet.
template <class T, int R>
[[gnu::flatten]] EliminationHalt<T, R> eliminate_halves(Walks<T, R>& walks, Resume from, TridiagonalFactors& factors) {
  std::vector<TridiagonalBlock<T, R>>& blocks = factors.blocks<T, R>();
  std::vector<EliminationHalt<T, R>>& halts = factors.halts<T, R>();
  const T half = 0.5 * walks.direction();
  EliminationHalt<T, R> now;
  auto& [carried, minor] = now;
  // Only a chain that is solved alone forks.
  const int at_tip = walks.forks() ? walks.lane(1).wait : -1;
  const int begin = std::min(from.step, walks.steps() - 1) / between_halts;
  if (begin > 0) now = halts[begin];
  if (from.backward_anew) restart_backward(now);
  for (int t = begin * between_halts; t < walks.steps(); ++t) {
    if (t % between_halts == 0) halts[t / between_halts] = now;
    walks.move_to(t);
    if (t == at_tip) set_lane(carried, 1, lane_of(carried, 1) + row_of_branches<R>(*walks.lane(1).chain));
    TridiagonalBlock<T, R>& block = blocks[t];
    const S3<T> H = walks.symmetric(at_H);
    const V3<T> m = half * walks.vector(at_m);
    Coupling<T, R>& C = block.turn_coupling;
    C.v = {{-H.xx, -H.xy - m.z, m.y - H.xz}, {m.z - H.xy, -H.yy, -H.yz - m.x}, {-H.xz - m.y, m.x - H.yz, -H.zz}};
    for (int k = 0; k < R; ++k) {
      C.vr[k] = walks.vector(walks.of_roll(k, at_u)), C.rv[k] = walks.vector(walks.of_roll(k, at_w));
      C.rr[k] = walks.read(walks.of_roll(k, at_c));
    }
    block.force_coupling = walks.symmetric(at_P_ahead);
    const BlockRow<T, R> own = row<T, R>(
        walks.symmetric(at_P_behind) + block.force_coupling, [&](int n) { return walks.read(n); },
        [&](int k, int n) { return walks.read(walks.of_roll(k, n)); });
    carried = eliminate(own + carried, block, minor);
  }
  return now;
}

template <int R>
void store_solution(BlockTridiagonal& chain, int j, const V3<double>& turn, const Rolls<double, R>& rolls,
                    const V3<double>& force) {
  store3(chain.turn, j, turn), store3(chain.force, j, force);
  for (int m = 0; m < R; ++m) chain.rolls[m].turn.at(0)[j] = rolls[m];
}

/// Back substitution from the meeting point towards the ends, down to step `last`.
template <class T, int R>
[[gnu::flatten]] void substitute_back(const Walks<T, R>& walks, const std::vector<TridiagonalBlock<T, R>>& blocks,
                                      int last, BlockTridiagonal& first, BlockTridiagonal* second, Turn<T, R> turn,
                                      V3<T> force) {
  for (int t = walks.steps() - 1; t >= last; --t) {
    const TridiagonalBlock<T, R>& b = blocks[t];
    const Coupling<T, R>& C = b.turn_coupling;
    Turn<T, R> torque = b.torque;
    torque.v = torque.v - C.v * turn.v;
    for (int m = 0; m < R; ++m) {
      torque.v = torque.v - turn.r[m] * C.vr[m];
      torque.r[m] = torque.r[m] - madd(C.rr[m], turn.r[m], dot(C.rv[m], turn.v));
    }
    Turn<T, R> next;
    apply_inverse(b.S_inv, b.A_inv, b.W, torque, b.gap - b.force_coupling * force, next, force);
    turn = next;
    for (int l = 0; l < Walks<T, R>::lanes; ++l) {
      if (t < walks.lane(l).wait) continue;
      Rolls<double, R> rolls;
      for (int m = 0; m < R; ++m) rolls[m] = turn.r[m][l];
      store_solution<R>(l < halves ? first : *second, walks.lane(l).element(t), lane_of(turn.v, l), rolls,
                        lane_of(force, l));
    }
  }
}

/// Calls call(integral constant) with the number of rolls.
template <class Call>
void by_rolls(int rolls, Call&& call) {
  switch (rolls) {
    case 0:
      return call(std::integral_constant<int, 0>());
    case 1:
      return call(std::integral_constant<int, 1>());
    case 2:
      return call(std::integral_constant<int, 2>());
    case 3:
      return call(std::integral_constant<int, 3>());
    default:
      return call(std::integral_constant<int, 4>());
  }
}

}  // namespace ostium::core
