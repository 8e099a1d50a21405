#include "core/solver/fork.h"

#include <Eigen/LU>
#include <cassert>

#include "core/math/alignment.h"
#include "core/solver/elimination.h"

namespace ostium::core {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int most = 6 + max_rolls;  // unknowns of an element, or of what a branch hangs on
using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most, 1>;

/// A branch without its elements: what it leaves on y = (turn, rolls of the joints, move of the node), and how its
/// first element follows.
struct Condensed {
  Dense S;
  Column c;
  Dense follows;  ///< per unit of y, its sign reversed: turn, rolls, force of the first element
  Column at_rest;
  double minor = 1;
};

Matrix3d dense(const S3<double>& s) {
  Matrix3d out;
  out << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return out;
}
S3<double> symmetric(const Matrix3d& m) {
  const auto mean = [&](int i, int j) { return (m(i, j) + m(j, i)) / 2; };
  return {m(0, 0), mean(0, 1), mean(0, 2), m(1, 1), mean(1, 2), m(2, 2)};
}
Matrix3d skew(const Vector3d& v) {
  Matrix3d out;
  out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return out;
}

/// Coupling of the first element (rows: turn, rolls, force) to y (columns), and the joints' own part of S and c.
void couple(const ForkBranch& branch, int rolls, double geometric, Dense& E, Condensed& out) {
  const int joints = branch.joint_count, size = 6 + joints;
  E.setZero(6 + rolls, size);
  out.S.setZero(size, size), out.c.setZero(size);
  for (int k = 0; k < joints; ++k) {
    const BranchJoint& joint = branch.joints[k];
    const Vector3d m = to_eigen(joint.moment), a = to_eigen(joint.axis), b = to_eigen(joint.own_axis);
    const Matrix3d H = dense(joint.stiffness), X = -H + geometric * skew(m);
    E.block<3, 3>(0, 0) += X.transpose();
    E.block<3, 1>(0, 3 + k) += X.transpose() * a;
    if (joint.own_roll >= 0) {
      E.block<1, 3>(3 + joint.own_roll, 0) += (X * b).transpose();
      E(3 + joint.own_roll, 3 + k) += (X * b).dot(a);
    }
    out.S.block<3, 3>(0, 0) += H;
    out.S.block<3, 1>(0, 3 + k) += H * a;
    out.S.block<1, 3>(3 + k, 0) += (H * a).transpose();
    out.S(3 + k, 3 + k) += a.dot(H * a);
    out.c.segment<3>(0) += m;
    out.c[3 + k] += a.dot(m);
  }
  E.block<3, 3>(3 + rolls, 3 + joints) = -Matrix3d::Identity();
}

/// Eliminates a branch from its tip, its first element included.
template <int R>
void condense(const ForkBranch& branch, double geometric, Condensed& out) {
  BlockTridiagonal& chain = *branch.chain;
  chain.meets_at = chain.first, chain.in_part = false;
  Walks<Pair, R> walks(chain, chain);
  assert(static_cast<int>(branch.factors->template blocks<Pair, R>().size()) > walks.steps());
  const auto [carried, minor] = eliminate_halves<Pair, R>(walks, {}, *branch.factors);
  const BlockRow<double, R> row = middle_row<R>(chain) + lane_of(carried, 1);
  S3<double> A_inv;
  Lever<double, R> W;
  Stiffness<double, R> S_inv;
  double own_minor = 1;
  factorise(row, A_inv, W, S_inv, own_minor);
  out.minor = std::min(minor[1], own_minor);

  Dense E;
  couple(branch, R, geometric, E, out);
  const auto solved = [&](const Turn<double, R>& torque, const V3<double>& gap, auto&& column) {
    Turn<double, R> turn;
    V3<double> force;
    apply_inverse(S_inv, A_inv, W, torque, gap, turn, force);
    column.template segment<3>(0) = to_eigen(turn.v);
    for (int m = 0; m < R; ++m) column[3 + m] = turn.r[m];
    column.template segment<3>(3 + R) = to_eigen(force);
  };
  out.at_rest.resize(6 + R), out.follows.resize(6 + R, E.cols());
  solved(row.torque, row.gap, out.at_rest);
  for (int y = 0; y < E.cols(); ++y) {
    Turn<double, R> torque;
    torque.v = from_eigen(E.col(y).segment<3>(0));
    for (int m = 0; m < R; ++m) torque.r[m] = E(3 + m, y);
    solved(torque, from_eigen(E.col(y).segment<3>(3 + R)), out.follows.col(y));
  }
  out.S.noalias() -= E.transpose() * out.follows;
  out.c.noalias() -= E.transpose() * out.at_rest;
}

/// Writes a branch's solution, given y.
template <int R>
void follow(const ForkBranch& branch, const Condensed& condensed, const Column& y) {
  BlockTridiagonal& chain = *branch.chain;
  const Column first = condensed.at_rest - condensed.follows * y;
  const V3<double> phi = from_eigen(first.segment<3>(0)), n = from_eigen(first.segment<3>(3 + R));
  Turn<Pair, R> turn{};
  V3<Pair> force{};
  Rolls<double, R> psi;
  for (int m = 0; m < R; ++m) psi[m] = first[3 + m];
  store_solution<R>(chain, chain.first, phi, psi, n);
  for (int l = 0; l < halves; ++l) {
    set_lane(turn.v, l, phi), set_lane(force, l, n);
    for (int m = 0; m < R; ++m) turn.r[m][l] = psi[m];
  }
  const Walks<Pair, R> walks(chain, chain);
  substitute_back(walks, branch.factors->template blocks<Pair, R>(), 0, chain, nullptr, turn, force);
}

}  // namespace

bool solve_fork(BlockTridiagonal& trunk, TridiagonalFactors& factors, std::span<ForkBranch* const> branches,
                double geometric, int from) {
  assert(branches.size() <= max_branches);
  const int last = trunk.elements - 1, rolls = trunk.roll_count, x = 3 + rolls;
  Condensed condensed[max_branches];
  Dense S = Dense::Zero(x + 3, x + 3);
  Column c = Column::Zero(x + 3);
  const auto place = [&](const ForkBranch& branch, int y) {  // among the trunk's turn, rolls, and the node's move
    if (y < 3) return y;
    return y < 3 + branch.joint_count ? 3 + branch.joints[y - 3].roll : x + y - 3 - branch.joint_count;
  };
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const ForkBranch& branch = *branches[b];
    by_rolls(branch.chain->roll_count, [&](auto R) { condense<R>(branch, geometric, condensed[b]); });
    const int size = 6 + branch.joint_count;
    for (int i = 0; i < size; ++i) {
      c[place(branch, i)] += condensed[b].c[i];
      for (int j = 0; j < size; ++j) S(place(branch, i), place(branch, j)) += condensed[b].S(i, j);
    }
  }

  const Matrix3d P = dense(load6<double>(trunk.compliance, trunk.elements));
  const Matrix3d P_left = (Matrix3d::Identity() + P * S.block<3, 3>(x, x)).inverse() * P;  // P'
  const Dense lever = S.block(0, x, x, 3) * P_left;
  const Dense K = S.block(0, 0, x, x) - lever * S.block(x, 0, 3, x);
  const Column torque = c.head(x) - lever * c.segment<3>(x);
  TipRow& tip = trunk.branches;
  tip.K = symmetric(K.block<3, 3>(0, 0));
  tip.G = {from_eigen(-lever.row(0)), from_eigen(-lever.row(1)), from_eigen(-lever.row(2))};
  tip.A = symmetric(P_left - P);
  tip.torque = from_eigen(torque.head<3>()), tip.gap = from_eigen(-P_left * c.segment<3>(x));
  for (int m = 0; m < rolls; ++m) {
    tip.with_roll[m] = from_eigen(K.block<3, 1>(0, 3 + m));
    tip.roll_G[m] = from_eigen(-lever.row(3 + m));
    tip.roll_torque[m] = torque[3 + m];
    for (int l = 0; l < rolls; ++l) tip.rolls[m][l] = (K(3 + m, 3 + l) + K(3 + l, 3 + m)) / 2;
  }
  trunk.forks = true;
  const bool within = from >= 0 && solve_within(trunk, from, last, factors);
  if (!within) solve(trunk, nullptr, factors);

  Column turned(x);
  turned.head<3>() = to_eigen(load3<double>(trunk.turn, last));
  for (int m = 0; m < rolls; ++m) turned[3 + m] = trunk.rolls[m].turn.at(0)[last];
  const Vector3d move = P_left * (c.segment<3>(x) - S.block(x, 0, 3, x) * turned - trunk.force[last]);
  trunk.pull = {};
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const ForkBranch& branch = *branches[b];
    Column y(6 + branch.joint_count);
    y.head<3>() = turned.head<3>(), y.tail<3>() = move;
    for (int k = 0; k < branch.joint_count; ++k) y[3 + k] = turned[3 + branch.joints[k].roll];
    by_rolls(branch.chain->roll_count, [&](auto R) { follow<R>(branch, condensed[b], y); });
    trunk.pull = trunk.pull + load3<double>(branch.chain->force, branch.chain->first);
    trunk.definite = trunk.definite && condensed[b].minor > 0;
  }
  for (const ForkBranch* branch : branches) branch->chain->definite = trunk.definite;
  return within;
}

}  // namespace ostium::core
