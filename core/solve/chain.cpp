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

/// What two lanes solve: the matrix of a chain with its own right-hand side or another.
struct Problem {
  const Chain* chain;
  const Field<3>*torque, *gap;
  Field<3>*turn = nullptr, *force = nullptr;

  explicit Problem(const Chain& c) : chain(&c), torque(&c.torque), gap(&c.gap) {}  // to look at
  explicit Problem(Chain& c) : chain(&c), torque(&c.torque), gap(&c.gap), turn(&c.turn), force(&c.force) {}
  Problem(const Chain& c, ChainLoad& l) : chain(&c), torque(&l.torque), gap(&l.gap), turn(&l.turn), force(&l.force) {}
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

/// The four lanes of a solve, and what they read at a step.
class Walks {
 public:
  Walks(const Problem& first, const Problem& second) {
    for (int l = 0; l < lane_count; ++l) {
      const bool forward = l % halves == 0;
      const Chain& chain = *(l < halves ? first : second).chain;
      lanes_[l] = {&chain, forward, forward ? middle(chain) - chain.first : chain.elements - 1 - middle(chain), 0};
      direction_[l] = forward ? 1.0 : -1.0;
      steps_ = std::max(steps_, lanes_[l].blocks);
    }
    for (int l = 0; l < lane_count; ++l) {
      lanes_[l].wait = steps_ - lanes_[l].blocks;
      // Seen from an element, the node behind is its own when walking forward, the next one when walking back.
      const Problem& problem = l < halves ? first : second;
      const Chain& c = *problem.chain;
      const int behind = lanes_[l].forward ? 0 : 1, ahead = 1 - behind;
      const auto from = [&](int number, const auto& field, int components, int shift) {
        for (int k = 0; k < components; ++k) source_[number + k][l] = field.at(k) + shift;
      };
      from(at_K, c.stiffness, 6, 0);
      from(at_arm, c.arm, 3, 0);
      from(at_torque, *problem.torque, 3, 0);
      from(at_gap, *problem.gap, 3, 0);
      from(at_P_behind, c.compliance, 6, behind);
      from(at_H, c.joint_stiffness, 6, ahead);
      from(at_m, c.joint_moment, 3, ahead);
      from(at_P_ahead, c.compliance, 6, ahead);
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
  V3<Lanes> vector(Number n) const { return {read(n), read(n + 1), read(n + 2)}; }
  S3<Lanes> symmetric(Number n) const {
    return {read(n), read(n + 1), read(n + 2), read(n + 3), read(n + 4), read(n + 5)};
  }

 private:
  Walk lanes_[lane_count];
  Lanes direction_{};
  int steps_ = 0;
  const double* source_[numbers][lane_count];
  int at_[lane_count];
};

/// Block row of one element: [K G; G^T -A] and its right-hand side.
template <class T>
struct Row {
  S3<T> K;
  M3<T> G;
  S3<T> A;
  V3<T> torque, gap;
};
template <class T>
Row<T> operator+(const Row<T>& a, const Row<T>& b) {
  return {
      a.K + b.K, {a.G.r0 + b.G.r0, a.G.r1 + b.G.r1, a.G.r2 + b.G.r2}, a.A + b.A, a.torque + b.torque, a.gap + b.gap};
}
template <class T>
Row<T> row(const S3<T>& K, const V3<T>& d, const S3<T>& P_sum, const V3<T>& torque, const V3<T>& gap) {
  const V3<T> e = splat<T>(tunables::axial_give_per_N_m) * d;
  const S3<T> A{madd(e.x, d.x, P_sum.xx), madd(e.x, d.y, P_sum.xy), madd(e.x, d.z, P_sum.xz),
                madd(e.y, d.y, P_sum.yy), madd(e.y, d.z, P_sum.yz), madd(e.z, d.z, P_sum.zz)};
  return {K, {{T{}, d.z, -d.y}, {-d.z, T{}, d.x}, {d.y, -d.x, T{}}}, A, torque, gap};  // G = -[d]x
}

/// D^-1 (torque, gap) for D = [K G; G^T -A].
template <class T>
void apply_inverse(const S3<T>& S_inv, const S3<T>& A_inv, const M3<T>& W, const V3<T>& torque, const V3<T>& gap,
                   V3<T>& turn, V3<T>& force) {
  turn = S_inv * (torque + W * gap);
  force = transpose_times(W, turn) - A_inv * gap;
}

/// Positive where a symmetric matrix is positive definite, else not: the least of its leading minors.
template <class T>
T least_minor(const S3<T>& s) {
  const T second = nmadd(s.xy, s.xy, s.xx * s.yy);
  const T third = madd(s.xx, nmadd(s.yz, s.yz, s.yy * s.zz),
                       madd(s.xy, nmadd(s.xy, s.zz, s.xz * s.yz), s.xz * nmadd(s.xz, s.yy, s.xy * s.yz)));
  return least(s.xx, least(second, third));
}

/// Eliminates a row; returns what it leaves on the next one, -E^T D^-1 E and -E^T D^-1 b with
/// E = diag(turn_coupling, force_coupling).
Row<Lanes> eliminate(const Row<Lanes>& r, ChainBlock& block, Lanes& minor) {
  const S3<Lanes> A_inv = inverse(r.A);
  const M3<Lanes> W = r.G * A_inv;
  const S3<Lanes> S = r.K + symmetric_times_transpose(W, r.G);
  minor = least(minor, least_minor(S));
  const S3<Lanes> S_inv = inverse(S);
  block.S_inv = S_inv, block.A_inv = A_inv, block.W = W;
  block.torque = r.torque, block.gap = r.gap;

  const M3<Lanes>& C = block.turn_coupling;
  const S3<Lanes>& P = block.force_coupling;
  const M3<Lanes> SC = S_inv * C;
  const M3<Lanes> WP = W * P;
  const M3<Lanes> SWP = S_inv * WP;
  const M3<Lanes> AP{A_inv * V3<Lanes>{P.xx, P.xy, P.xz}, A_inv * V3<Lanes>{P.xy, P.yy, P.yz},
                     A_inv * V3<Lanes>{P.xz, P.yz, P.zz}};
  const M3<Lanes> P_rows{{P.xx, P.xy, P.xz}, {P.xy, P.yy, P.yz}, {P.xz, P.yz, P.zz}};
  Row<Lanes> left;
  left.K = S3<Lanes>{} - symmetric_transpose_times(C, SC);
  left.G = transpose_times(C, SWP);
  left.G = {V3<Lanes>{} - left.G.r0, V3<Lanes>{} - left.G.r1, V3<Lanes>{} - left.G.r2};
  left.A = symmetric_transpose_times(WP, SWP) - symmetric_times_transpose(P_rows, AP);
  V3<Lanes> turn, force;
  apply_inverse(S_inv, A_inv, W, r.torque, r.gap, turn, force);
  left.torque = V3<Lanes>{} - transpose_times(C, turn);
  left.gap = V3<Lanes>{} - P * force;
  return left;
}

V3<double> lane_of(const V3<Lanes>& a, int l) { return {a.x[l], a.y[l], a.z[l]}; }
S3<double> lane_of(const S3<Lanes>& a, int l) { return {a.xx[l], a.xy[l], a.xz[l], a.yy[l], a.yz[l], a.zz[l]}; }
Row<double> lane_of(const Row<Lanes>& r, int l) {
  return {lane_of(r.K, l),
          {lane_of(r.G.r0, l), lane_of(r.G.r1, l), lane_of(r.G.r2, l)},
          lane_of(r.A, l),
          lane_of(r.torque, l),
          lane_of(r.gap, l)};
}
void set_lane(V3<Lanes>& a, int l, const V3<double>& b) { a.x[l] = b.x, a.y[l] = b.y, a.z[l] = b.z; }

Row<double> middle_row(const Problem& p) {
  const Chain& c = *p.chain;
  const int m = middle(c);
  return row(load6<double>(c.stiffness, m), load3<double>(c.arm, m),
             load6<double>(c.compliance, m) + load6<double>(c.compliance, m + 1), load3<double>(*p.torque, m),
             load3<double>(*p.gap, m));
}

void set_lane(S3<Lanes>& a, int l, const S3<double>& b) {
  a.xx[l] = b.xx, a.xy[l] = b.xy, a.xz[l] = b.xz, a.yy[l] = b.yy, a.yz[l] = b.yz, a.zz[l] = b.zz;
}

/// Towards the middle: fills the blocks, returns what all lanes leave on their middle element.
[[gnu::flatten]] Row<Lanes> eliminate_halves(Walks& walks, ChainFactors& factors, Lanes& minor) {
  const Lanes half = 0.5 * walks.direction();
  Row<Lanes> carried{};
  for (int t = 0; t < walks.steps(); ++t) {
    walks.move_to(t);
    ChainBlock& block = factors.blocks[t];
    const S3<Lanes> H = walks.symmetric(at_H);
    const V3<Lanes> m = half * walks.vector(at_m);
    block.turn_coupling = {
        {-H.xx, -H.xy - m.z, m.y - H.xz}, {m.z - H.xy, -H.yy, -H.yz - m.x}, {-H.xz - m.y, m.x - H.yz, -H.zz}};
    block.force_coupling = walks.symmetric(at_P_ahead);
    const Row<Lanes> own =
        row(walks.symmetric(at_K), walks.vector(at_arm), walks.symmetric(at_P_behind) + block.force_coupling,
            walks.vector(at_torque), walks.vector(at_gap));
    carried = eliminate(own + carried, block, minor);
  }
  return carried;
}

/// Solves a chain's middle element, and hands its solution to both lanes; false if the matrix is not definite.
bool solve_middle(const Problem& problem, int front, const Row<Lanes>& carried, const Lanes& minor, ChainBlock& block,
                  V3<Lanes>& turn, V3<Lanes>& force) {
  const Row<double> r = middle_row(problem) + lane_of(carried, front) + lane_of(carried, front + 1);
  const S3<double> A_inv = inverse(r.A);
  const M3<double> W = r.G * A_inv;
  const S3<double> S = r.K + symmetric_times_transpose(W, r.G);
  const S3<double> S_inv = inverse(S);
  V3<double> phi, n;
  apply_inverse(S_inv, A_inv, W, r.torque, r.gap, phi, n);
  store3(*problem.turn, middle(*problem.chain), phi);
  store3(*problem.force, middle(*problem.chain), n);
  for (int l : {front, front + 1}) {
    set_lane(turn, l, phi), set_lane(force, l, n);
    set_lane(block.S_inv, l, S_inv), set_lane(block.A_inv, l, A_inv);
  }
  return minor[front] > 0 && minor[front + 1] > 0 && least_minor(S) > 0;
}

/// From the middle back to the ends.
[[gnu::flatten]] void substitute_back(const Walks& walks, const ChainFactors& factors, const Problem& first,
                                      const Problem* second, V3<Lanes> turn, V3<Lanes> force) {
  const int lanes = second ? lane_count : halves;
  for (int t = walks.steps() - 1; t >= 0; --t) {
    const ChainBlock& b = factors.blocks[t];
    apply_inverse<Lanes>(b.S_inv, b.A_inv, b.W, b.torque - b.turn_coupling * turn, b.gap - b.force_coupling * force,
                         turn, force);
    for (int l = 0; l < lanes; ++l) {
      if (t < walks.lane(l).wait) continue;
      const int j = walks.lane(l).element(t);
      const Problem& problem = l < halves ? first : *second;
      store3(*problem.turn, j, lane_of(turn, l));
      store3(*problem.force, j, lane_of(force, l));
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

/// Whether the matrices are definite.
std::pair<bool, bool> solve(const Problem& first, const Problem* second, ChainFactors& factors) {
  assert(static_cast<int>(factors.blocks.size()) >
         std::max(first.chain->elements, second ? second->chain->elements : 0) / 2);
  Walks walks(first, second ? *second : first);
  Lanes minor = splat<Lanes>(1);
  const Row<Lanes> carried = eliminate_halves(walks, factors, minor);

  V3<Lanes> turn{}, force{};
  std::pair<bool, bool> definite{true, true};
  ChainBlock& middle_block = factors.blocks[walks.steps()];
  definite.first = solve_middle(first, 0, carried, minor, middle_block, turn, force);
  if (second) definite.second = solve_middle(*second, halves, carried, minor, middle_block, turn, force);
  substitute_back(walks, factors, first, second, turn, force);
  return definite;
}

}  // namespace

Chain::Chain(int elements)
    : elements(elements),
      stiffness(elements + 1),
      joint_stiffness(elements + 1),
      joint_moment(elements + 1),
      arm(elements + 1),
      compliance(elements + 1),
      torque(elements + 1),
      gap(elements + 1),
      turn(elements + 1),
      force(elements + 1) {
  write_idle_entries(*this);
}

void solve(Chain& first, Chain* second, ChainFactors& factors) {
  const Problem one(first);
  if (!second) {
    first.definite = solve(one, nullptr, factors).first;
    return;
  }
  const Problem two(*second);
  std::tie(first.definite, second->definite) = solve(one, &two, factors);
}

void solve(Chain& chain, ChainLoad& load, ChainFactors& factors) {
  const Problem more(chain, load);
  chain.definite = solve(Problem(chain), &more, factors).first;
}

int negative_pivots(const Chain& chain, const ChainFactors& factors) {
  // Inertia of the whole system: it has 3 N negative eigenvalues for its 3 N constraint forces; more are unstable.
  const Walks walks(Problem{chain}, Problem{chain});
  int negative = 0;
  const auto count = [&](int t, int l) {
    negative += negatives(lane_of(factors.blocks[t].S_inv, l)) + 3 - negatives(lane_of(factors.blocks[t].A_inv, l));
  };
  for (int t = 0; t < walks.steps(); ++t)
    for (int l = 0; l < halves; ++l)
      if (t >= walks.lane(l).wait) count(t, l);
  count(walks.steps(), 0);
  return negative - 3 * (chain.elements - chain.first);
}

}  // namespace ostium
