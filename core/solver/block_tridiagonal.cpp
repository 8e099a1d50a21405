#include "core/solver/block_tridiagonal.h"

#include <algorithm>
#include <cassert>

#include "core/base/tolerances.h"
#include "core/solver/block.h"
#include "core/solver/block_tridiagonal_walks.h"
#include "core/solver/tridiagonal_factors.h"

namespace ostium::core {

namespace {

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

/// Lanes that run backward have eliminated nothing yet.
template <class T, int R>
void restart_backward(EliminationHalt<T, R>& halt) {
  const BlockRow<double, R> nothing{};
  BlockRow<T, R>& c = halt.carried;
  for (int l = 1; l < Walks<T, R>::lanes; l += halves) {
    set_lane(c.K.v, l, nothing.K.v), set_lane(c.A, l, nothing.A);
    set_lane(c.G.v.r0, l, nothing.G.v.r0), set_lane(c.G.v.r1, l, nothing.G.v.r1), set_lane(c.G.v.r2, l, nothing.G.v.r2);
    set_lane(c.torque.v, l, nothing.torque.v), set_lane(c.gap, l, nothing.gap);
    for (int m = 0; m < R; ++m) {
      set_lane(c.K.vr[m], l, {}), set_lane(c.G.r[m], l, {});
      c.torque.r[m][l] = 0;
      for (int k = 0; k < R; ++k) c.K.rr[m][k][l] = 0;
    }
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
  const int begin = std::min(from.step, walks.steps() - 1) / between_halts;
  if (begin > 0) now = halts[begin];
  if (from.backward_anew) restart_backward(now);
  for (int t = begin * between_halts; t < walks.steps(); ++t) {
    if (t % between_halts == 0) halts[t / between_halts] = now;
    walks.move_to(t);
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

/// Solves the element where both eliminations of a chain meet and passes its solution to both lanes; false if the
/// matrix is not definite.
template <class T, int R>
bool solve_middle(BlockTridiagonal& chain, int front, const BlockRow<T, R>& carried, const T& minor,
                  TridiagonalBlock<T, R>& block, Turn<T, R>& turn, V3<T>& force) {
  const BlockRow<double, R> r = middle_row<R>(chain) + lane_of(carried, front) + lane_of(carried, front + 1);
  S3<double> A_inv;
  Lever<double, R> W;
  Stiffness<double, R> S_inv;
  double own_minor = 1;
  factorise(r, A_inv, W, S_inv, own_minor);
  Turn<double, R> phi;
  V3<double> n;
  apply_inverse(S_inv, A_inv, W, r.torque, r.gap, phi, n);
  store_solution<R>(chain, chain.meets_at, phi.v, phi.r, n);
  for (int l : {front, front + 1}) {
    set_lane(turn.v, l, phi.v), set_lane(force, l, n);
    for (int m = 0; m < R; ++m) turn.r[m][l] = phi.r[m];
    set_lane(block.S_inv.v, l, S_inv.v), set_lane(block.A_inv, l, A_inv);
  }
  return minor[front] > 0 && minor[front + 1] > 0 && own_minor > 0;
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

/// Number of negative eigenvalues of a symmetric 3 x 3 matrix, from the signs of its pivots.
int negatives(const S3<double>& s) {
  const double first = s.xx, second = s.yy - s.xy * s.xy / s.xx;
  const double yz = s.yz - s.xy * s.xz / s.xx;
  const double third = s.zz - s.xz * s.xz / s.xx - yz * yz / second;
  return (first < 0) + (second < 0) + (third < 0);
}

/// Solves one chain (T: Pair) or two (Lanes) from where `resume` says, and writes the solution down to step `last`.
template <class T, int R>
void solve_with(BlockTridiagonal& first, BlockTridiagonal* second, Resume resume, int last,
                TridiagonalFactors& factors) {
  std::vector<TridiagonalBlock<T, R>>& blocks = factors.blocks<T, R>();
  Walks<T, R> walks(first, second ? *second : first);
  assert(static_cast<int>(blocks.size()) > walks.steps());
  const auto [carried, minor] = eliminate_halves(walks, resume, factors);

  Turn<T, R> turn{};
  V3<T> force{};
  TridiagonalBlock<T, R>& middle_block = blocks[walks.steps()];
  first.definite = solve_middle(first, 0, carried, minor, middle_block, turn, force);
  if constexpr (Walks<T, R>::lanes > halves)
    second->definite = solve_middle(*second, halves, carried, minor, middle_block, turn, force);
  substitute_back(walks, blocks, last, first, second, turn, force);
}

/// Writes the whole solution from that of the element where the eliminations meet.
template <int R>
void complete_with(BlockTridiagonal& chain, const TridiagonalFactors& factors) {
  const Walks<Pair, R> walks(chain, chain);
  const V3<double> phi = load3<double>(chain.turn, chain.meets_at), n = load3<double>(chain.force, chain.meets_at);
  Turn<Pair, R> turn{};
  V3<Pair> force{};
  for (int l = 0; l < halves; ++l) {
    set_lane(turn.v, l, phi), set_lane(force, l, n);
    for (int m = 0; m < R; ++m) turn.r[m][l] = chain.rolls[m].turn.at(0)[chain.meets_at];
  }
  substitute_back(walks, factors.blocks<Pair, R>(), 0, chain, nullptr, turn, force);
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
    default:
      return call(std::integral_constant<int, 3>());
  }
}

void solve_from(Resume resume, int last, BlockTridiagonal& first, BlockTridiagonal* second,
                TridiagonalFactors& factors) {
  by_rolls(first.roll_count, [&](auto rolls) {
    second ? solve_with<Lanes, rolls>(first, second, resume, last, factors)
           : solve_with<Pair, rolls>(first, nullptr, resume, last, factors);
  });
}

}  // namespace

void solve(BlockTridiagonal& first, BlockTridiagonal* second, TridiagonalFactors& factors) {
  assert(!second || second->roll_count == first.roll_count);
  for (BlockTridiagonal* chain : {&first, second})
    if (chain) chain->meets_at = middle(*chain), chain->in_part = false;
  solve_from({}, 0, first, second, factors);
}

void solve_again(BlockTridiagonal& chain, int same, TridiagonalFactors& factors) {
  assert(same >= 0);
  if (chain.meets_at != middle(chain)) return solve(chain, nullptr, factors);
  solve_from({same, false}, 0, chain, nullptr, factors);
}

bool solve_within(BlockTridiagonal& chain, int from, int to, TridiagonalFactors& factors) {
  const int first = chain.first, N = chain.elements, before = chain.meets_at;
  assert(first <= from && from <= to && to < N);
  if (from <= middle(chain)) return false;
  const bool moves = before < from || before > to;
  if (moves) chain.meets_at = (from + to) / 2;
  // A forward lane begins at step 0, a backward one so late that both arrive together. Halts reach to before the last
  // meeting point.
  const int wait = chain.meets_at - first - (N - 1 - chain.meets_at);
  const int behind = wait + N - 1 - to, ahead = from - first;
  const Resume resume =
      moves ? Resume{std::min({before - first - 1, ahead, wait}), true} : Resume{std::min(ahead, behind)};
  solve_from(resume, std::max(0, std::min(ahead, behind)), chain, nullptr, factors);
  chain.in_part = true;
  return true;
}

void complete(BlockTridiagonal& chain, const TridiagonalFactors& factors) {
  if (!chain.in_part) return;
  by_rolls(chain.roll_count, [&](auto rolls) { complete_with<rolls>(chain, factors); });
  chain.in_part = false;
}

int negative_pivots(const BlockTridiagonal& chain, const TridiagonalFactors& factors) {
  assert(chain.roll_count == 0);
  // Inertia of the whole system: 3 N negative eigenvalues belong to the 3 N constraint forces; any more are
  // instabilities.
  const Walks<Pair, 0> walks(chain, chain);
  int negative = 0;
  const auto count = [&](int t, int l) {
    const TridiagonalBlock<Pair, 0>& block = factors.blocks<Pair, 0>()[t];
    negative += negatives(lane_of(block.S_inv.v, l)) + 3 - negatives(lane_of(block.A_inv, l));
  };
  for (int t = 0; t < walks.steps(); ++t)
    for (int l = 0; l < halves; ++l)
      if (t >= walks.lane(l).wait) count(t, l);
  count(walks.steps(), 0);
  return negative - 3 * (chain.elements - chain.first);
}

}  // namespace ostium::core
