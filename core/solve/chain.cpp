#include "core/solve/chain.h"

#include <algorithm>
#include <cassert>

namespace ostium {

namespace {

constexpr int halves = 2;

/// The element and node indices a lane visits: from one end of one chain towards its middle.
struct Walk {
  const Chain* chain;
  bool forward;  ///< from the base
  int blocks;    ///< how many elements before the middle one

  int element(int t) const { return forward ? t : chain->elements - 1 - t; }
  int node_behind(int t) const { return forward ? t : chain->elements - t; }
  int node_ahead(int t) const { return forward ? t + 1 : chain->elements - 1 - t; }
};

int middle(const Chain& chain) { return chain.elements / 2; }

/// Reads one block of four chains. A lane whose half is shorter starts later, and reads a regular block without
/// coupling from its padding until then.
class Gather {
 public:
  Gather(const Chain& first, const Chain* second) {
    const Chain& other = second ? *second : first;
    for (int l = 0; l < lane_count; ++l) {
      const Chain& chain = l < halves ? first : other;
      const bool forward = l % halves == 0;
      walk_[l] = {&chain, forward, forward ? middle(chain) : chain.elements - 1 - middle(chain)};
      sign_[l] = forward ? 1.0 : -1.0;
    }
    for (const Walk& w : walk_) steps_ = std::max(steps_, w.blocks);
  }

  int steps() const { return steps_; }
  Lanes direction() const { return sign_; }
  const Walk& walk(int lane) const { return walk_[lane]; }
  /// Block that lane l visits at step t, or -1.
  int block(int lane, int t) const { return t - (steps_ - walk_[lane].blocks); }

  void move_to(int t) {
    for (int l = 0; l < lane_count; ++l) {
      const int b = block(l, t), pad = walk_[l].chain->stiffness.stride() - 1;
      element_[l] = b < 0 ? pad : walk_[l].element(b);
      behind_[l] = b < 0 ? pad : walk_[l].node_behind(b);
      ahead_[l] = b < 0 ? pad - 1 : walk_[l].node_ahead(b);
      // A joint's fields live at its node.
    }
  }
  V3<Lanes> at_element(Field<3> Chain::*f) const { return {get(f, 0, element_), get(f, 1, element_), get(f, 2, element_)}; }
  V3<Lanes> at_node_ahead(Field<3> Chain::*f) const { return {get(f, 0, ahead_), get(f, 1, ahead_), get(f, 2, ahead_)}; }
  S3<Lanes> at_element(Field<6> Chain::*f) const { return symmetric(f, element_); }
  S3<Lanes> at_node_ahead(Field<6> Chain::*f) const { return symmetric(f, ahead_); }
  S3<Lanes> at_node_behind(Field<6> Chain::*f) const { return symmetric(f, behind_); }

 private:
  template <int K>
  Lanes get(Field<K> Chain::*f, int c, const int (&i)[lane_count]) const {
    return Lanes{(walk_[0].chain->*f).at(c)[i[0]], (walk_[1].chain->*f).at(c)[i[1]], (walk_[2].chain->*f).at(c)[i[2]],
                 (walk_[3].chain->*f).at(c)[i[3]]};
  }
  S3<Lanes> symmetric(Field<6> Chain::*f, const int (&i)[lane_count]) const {
    return {get(f, 0, i), get(f, 1, i), get(f, 2, i), get(f, 3, i), get(f, 4, i), get(f, 5, i)};
  }

  Walk walk_[lane_count];
  Lanes sign_{};
  int steps_ = 0;
  int element_[lane_count], behind_[lane_count], ahead_[lane_count];
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
  return {a.K + b.K, {a.G.r0 + b.G.r0, a.G.r1 + b.G.r1, a.G.r2 + b.G.r2}, a.A + b.A, a.torque + b.torque, a.gap + b.gap};
}
template <class T>
Row<T> row(const S3<T>& K, const V3<T>& d, const S3<T>& A, const V3<T>& torque, const V3<T>& gap) {
  return {K, {{T{}, d.z, -d.y}, {-d.z, T{}, d.x}, {d.y, -d.x, T{}}}, A, torque, gap};  // G = -[d]x
}

/// D^-1 (torque, gap) for D = [K G; G^T -A].
template <class T>
void apply_inverse(const S3<T>& S_inv, const S3<T>& A_inv, const M3<T>& W, const V3<T>& torque, const V3<T>& gap, V3<T>& turn,
                   V3<T>& force) {
  turn = S_inv * (torque + W * gap);
  force = transpose_times(W, turn) - A_inv * gap;
}

/// Eliminates a row; returns what it leaves on the next one, -E^T D^-1 E and -E^T D^-1 b with
/// E = diag(turn_coupling, force_coupling).
Row<Lanes> eliminate(const Row<Lanes>& r, ChainBlock& block) {
  const S3<Lanes> A_inv = inverse(r.A);
  const M3<Lanes> W = r.G * A_inv;
  const S3<Lanes> S_inv = inverse(r.K + symmetric_times_transpose(W, r.G));
  block.S_inv = S_inv, block.A_inv = A_inv, block.W = W;
  block.torque = r.torque, block.gap = r.gap;

  const M3<Lanes>& C = block.turn_coupling;
  const S3<Lanes>& P = block.force_coupling;
  const M3<Lanes> SC = S_inv * C;
  const M3<Lanes> WP = W * P;
  const M3<Lanes> SWP = S_inv * WP;
  const M3<Lanes> AP{A_inv * V3<Lanes>{P.xx, P.xy, P.xz}, A_inv * V3<Lanes>{P.xy, P.yy, P.yz}, A_inv * V3<Lanes>{P.xz, P.yz, P.zz}};
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

template <class T>
T lane_of(const T&, int);
V3<double> lane_of(const V3<Lanes>& a, int l) { return {a.x[l], a.y[l], a.z[l]}; }
S3<double> lane_of(const S3<Lanes>& a, int l) { return {a.xx[l], a.xy[l], a.xz[l], a.yy[l], a.yz[l], a.zz[l]}; }
Row<double> lane_of(const Row<Lanes>& r, int l) {
  return {lane_of(r.K, l), {lane_of(r.G.r0, l), lane_of(r.G.r1, l), lane_of(r.G.r2, l)}, lane_of(r.A, l), lane_of(r.torque, l),
          lane_of(r.gap, l)};
}
void set_lane(V3<Lanes>& a, int l, const V3<double>& b) { a.x[l] = b.x, a.y[l] = b.y, a.z[l] = b.z; }

Row<double> middle_row(const Chain& c) {
  const int m = middle(c);
  return row(load6<double>(c.stiffness, m), load3<double>(c.arm, m),
             load6<double>(c.compliance, m) + load6<double>(c.compliance, m + 1), load3<double>(c.torque, m),
             load3<double>(c.gap, m));
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
  // The regular block without coupling that a lane reads before its turn.
  const int pad = stiffness.stride() - 1;
  store6(stiffness, pad, identity3<double>());
  store6(compliance, pad, identity3<double>());
}

void solve(Chain& first, Chain* second, ChainFactors& factors) {
  Gather gather(first, second);
  const int steps = gather.steps();
  assert(static_cast<int>(factors.size()) > steps);
  const Lanes half = 0.5 * gather.direction();

  Row<Lanes> carried{};
  for (int t = 0; t < steps; ++t) {
    ChainBlock& block = factors[t];
    gather.move_to(t);
    const S3<Lanes> H = gather.at_node_ahead(&Chain::joint_stiffness);
    const V3<Lanes> m = half * gather.at_node_ahead(&Chain::joint_moment);
    block.turn_coupling = {{-H.xx, -H.xy - m.z, m.y - H.xz}, {m.z - H.xy, -H.yy, -H.yz - m.x}, {-H.xz - m.y, m.x - H.yz, -H.zz}};
    block.force_coupling = gather.at_node_ahead(&Chain::compliance);
    const Row<Lanes> own =
        row(gather.at_element(&Chain::stiffness), gather.at_element(&Chain::arm),
            gather.at_node_behind(&Chain::compliance) + block.force_coupling, gather.at_element(&Chain::torque),
            gather.at_element(&Chain::gap));
    carried = eliminate(own + carried, block);
  }

  V3<Lanes> turn, force;
  Chain* const chains[] = {&first, second};
  for (int c = 0; c < 2; ++c) {
    if (!chains[c]) continue;
    const int front = halves * c, back = front + 1;
    const Row<double> r = middle_row(*chains[c]) + lane_of(carried, front) + lane_of(carried, back);
    const S3<double> A_inv = inverse(r.A);
    const M3<double> W = r.G * A_inv;
    const S3<double> S_inv = inverse(r.K + symmetric_times_transpose(W, r.G));
    V3<double> phi, n;
    apply_inverse(S_inv, A_inv, W, r.torque, r.gap, phi, n);
    store3(chains[c]->turn, middle(*chains[c]), phi);
    store3(chains[c]->force, middle(*chains[c]), n);
    for (int l : {front, back}) set_lane(turn, l, phi), set_lane(force, l, n);
    // The middle's pivots, for negative_directions.
    for (int l : {front, back}) {
      S3<Lanes>&S = factors[steps].S_inv, &A = factors[steps].A_inv;
      S.xx[l] = S_inv.xx, S.xy[l] = S_inv.xy, S.xz[l] = S_inv.xz, S.yy[l] = S_inv.yy, S.yz[l] = S_inv.yz, S.zz[l] = S_inv.zz;
      A.xx[l] = A_inv.xx, A.xy[l] = A_inv.xy, A.xz[l] = A_inv.xz, A.yy[l] = A_inv.yy, A.yz[l] = A_inv.yz, A.zz[l] = A_inv.zz;
    }
  }

  const int lanes = second ? lane_count : halves;
  for (int t = steps - 1; t >= 0; --t) {
    const ChainBlock& b = factors[t];
    apply_inverse(b.S_inv, b.A_inv, b.W, b.torque - b.turn_coupling * turn, b.gap - b.force_coupling * force, turn, force);
    for (int l = 0; l < lanes; ++l) {
      const int block = gather.block(l, t);
      if (block < 0) continue;
      Chain& chain = *chains[l / halves];
      const int j = gather.walk(l).element(block);
      store3(chain.turn, j, lane_of(turn, l));
      store3(chain.force, j, lane_of(force, l));
    }
  }
}

namespace {
/// Number of negative eigenvalues of a symmetric 3 x 3 matrix, by the signs of its pivots.
int negatives(const S3<double>& s) {
  const double first = s.xx, second = s.yy - s.xy * s.xy / s.xx;
  const double yz = s.yz - s.xy * s.xz / s.xx;
  const double third = s.zz - s.xz * s.xz / s.xx - yz * yz / second;
  return (first < 0) + (second < 0) + (third < 0);
}
}  // namespace

int negative_directions(const Chain& chain, const ChainFactors& factors) {
  // Inertia of the whole system: it has 3 N negative eigenvalues for its 3 N constraint forces; more are unstable.
  const Gather gather(chain, nullptr);
  int negative = 0;
  const auto count = [&](int t, int l) {
    negative += negatives(lane_of(factors[t].S_inv, l)) + 3 - negatives(lane_of(factors[t].A_inv, l));
  };
  for (int t = 0; t < gather.steps(); ++t)
    for (int l = 0; l < halves; ++l)
      if (gather.block(l, t) >= 0) count(t, l);
  count(gather.steps(), 0);
  return negative - 3 * chain.elements;
}

}  // namespace ostium
