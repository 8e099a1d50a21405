#include "core/solver/block_tridiagonal.h"

#include <algorithm>
#include <cassert>

#include "core/solver/elimination.h"

namespace ostium::core {

namespace {

/// Solves the element where both eliminations of a chain meet and passes its solution to both lanes; false if the
/// matrix is not definite.
template <class T, int R>
bool solve_middle(BlockTridiagonal& chain, int front, const BlockRow<T, R>& carried, const T& minor,
                  TridiagonalBlock<T, R>& block, Turn<T, R>& turn, V3<T>& force) {
  BlockRow<double, R> r = middle_row<R>(chain) + lane_of(carried, front) + lane_of(carried, front + 1);
  if (chain.forks && chain.meets_at == chain.elements - 1) r = r + row_of_branches<R>(chain);
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
