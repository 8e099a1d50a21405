/// Chains that fork: the solver against a dense one, and rods side by side in one lumen.
#include "core/solver/fork.h"

#include <gtest/gtest.h>

#include "tests/core/random_chain.h"

namespace ostium::core {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Matrix3d dense(const S3<double>& s) {
  Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

/// A trunk with branches at its tip, and the same system as one dense matrix: the chains' unknowns one after the other,
/// then the move of the node that they share.
struct RandomFork {
  RandomFork(int trunk_rolls, const std::vector<std::vector<int>>& joined, unsigned seed)
      : trunk(17, seed, 0, trunk_rolls) {
    std::mt19937 generator(seed + 1);
    std::normal_distribution<> normal;
    const auto unit = [&] {
      return from_eigen(Vector3d(normal(generator), normal(generator), normal(generator)).normalized());
    };
    for (std::size_t b = 0; b < joined.size(); ++b) {
      const int rolls = static_cast<int>(joined[b].size()) - 1;
      chains.push_back(std::make_unique<RandomChain>(5 + 9 * static_cast<int>(b), seed + 10 + b, 0, rolls));
      factors.emplace_back();
      factors.back().resize(chains[b]->chain.elements, rolls);
    }
    for (std::size_t b = 0; b < joined.size(); ++b) {
      ForkBranch branch{&chains[b]->chain, &factors[b], static_cast<int>(joined[b].size()), {}};
      for (int k = 0; k < branch.joint_count; ++k) {
        Matrix3d a;
        a << Vector3d::Random(), Vector3d::Random(), Vector3d::Random();
        const Matrix3d H = a * a.transpose();
        branch.joints[k] = {joined[b][k], k - 1,  {H(0, 0), H(0, 1), H(0, 2), H(1, 1), H(1, 2), H(2, 2)},
                            unit(),       unit(), unit()};
      }
      branches.push_back(branch);
    }
    assemble();
  }

  void assemble() {
    const int N = trunk.chain.elements;
    int size = static_cast<int>(trunk.right.size());
    for (const auto& chain : chains) starts.push_back(size), size += static_cast<int>(chain->right.size());
    const int x = size, last = 6 * (N - 1);
    matrix = MatrixXd::Zero(size + 3, size + 3), right = VectorXd::Zero(size + 3);
    matrix.topLeftCorner(trunk.right.size(), trunk.right.size()) = trunk.matrix;
    right.head(trunk.right.size()) = trunk.right;
    // The last node's move is an unknown of its own: move = P (forces of the branches - force of the last element).
    const Matrix3d P = dense(load6<double>(trunk.chain.compliance, N));
    matrix.block<3, 3>(last + 3, last + 3) += P;
    matrix.block<3, 3>(last + 3, x) = Matrix3d::Identity();
    matrix.block<3, 3>(x, x) = Matrix3d::Identity();
    matrix.block<3, 3>(x, last + 3) = P;
    for (std::size_t b = 0; b < chains.size(); ++b) {
      const RandomChain& chain = *chains[b];
      const int at = starts[b], M = chain.chain.elements;
      matrix.block(at, at, chain.right.size(), chain.right.size()) = chain.matrix;
      right.segment(at, chain.right.size()) = chain.right;
      matrix.block<3, 3>(at + 3, x) = -Matrix3d::Identity();
      matrix.block<3, 3>(x, at + 3) = -P;
      for (int k = 0; k < branches[b].joint_count; ++k) {
        const BranchJoint& joint = branches[b].joints[k];
        // theta of both frames as rows over the unknowns.
        MatrixXd before = MatrixXd::Zero(3, size + 3), after = before;
        before.block<3, 3>(0, last) = after.block<3, 3>(0, at) = Matrix3d::Identity();
        before.col(6 * N + joint.roll * N + N - 1) = to_eigen(joint.axis);
        if (joint.own_roll >= 0) after.col(at + 6 * M + joint.own_roll * M) = to_eigen(joint.own_axis);
        const Matrix3d H = dense(joint.stiffness), X = -H + 0.5 * cross_matrix(to_eigen(joint.moment));
        matrix += before.transpose() * H * before + before.transpose() * X * after +
                  after.transpose() * X.transpose() * before;
        right += before.transpose() * to_eigen(joint.moment);
      }
    }
  }

  VectorXd solution() const {
    VectorXd out(right.size());
    out.head(trunk.right.size()) = trunk.solution();
    for (std::size_t b = 0; b < chains.size(); ++b)
      out.segment(starts[b], chains[b]->right.size()) = chains[b]->solution();
    const Matrix3d P = dense(load6<double>(trunk.chain.compliance, trunk.chain.elements));
    out.tail<3>() = P * (to_eigen(trunk.chain.pull) - trunk.chain.force[trunk.chain.elements - 1]);
    return out;
  }

  RandomChain trunk;
  std::vector<std::unique_ptr<RandomChain>> chains;
  std::vector<TridiagonalFactors> factors;
  std::vector<ForkBranch> branches;
  std::vector<int> starts;
  MatrixXd matrix;
  VectorXd right;
};

TEST(Fork, SolvesWhatADenseSolverSolves) {
  // Rolls of the trunk, and to which of them each branch is joined.
  const std::vector<std::pair<int, std::vector<std::vector<int>>>> forks = {
      {1, {{0}}}, {2, {{0}, {1}}}, {3, {{0, 1}, {2}}}, {4, {{0, 1}, {2, 3}}}, {3, {{0}, {2}, {1}}}};
  for (const auto& [rolls, joined] : forks)
    for (const bool tied : {false, true}) {
      RandomFork fork(rolls, joined, 5 + rolls);
      if (tied) {  // a wall holds the shared node in one direction
        const Vector3d n = Vector3d(1, 2, -1).normalized();
        const Matrix3d hold = Matrix3d::Identity() - n * n.transpose();
        BlockTridiagonal& chain = fork.trunk.chain;
        const int N = chain.elements;
        const Matrix3d before = dense(load6<double>(chain.compliance, N)), P = hold * before * hold;
        store6(chain.compliance, N, S3<double>{P(0, 0), P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2)});
        fork.trunk.matrix.block<3, 3>(6 * N - 3, 6 * N - 3) += before - P;
        fork.starts.clear();
        fork.assemble();
      }
      TridiagonalFactors factors;
      factors.resize(fork.trunk.chain.elements, rolls);
      std::vector<ForkBranch*> branches;
      for (ForkBranch& branch : fork.branches) branches.push_back(&branch);
      solve_fork(fork.trunk.chain, factors, branches, 0.5);
      const VectorXd exact = fork.matrix.fullPivLu().solve(fork.right);
      EXPECT_LT((fork.solution() - exact).norm() / exact.norm(), 1e-8) << rolls << " rolls, tied " << tied;
    }
}

// Where the trunk's far part has not changed, it is not eliminated again.
TEST(Fork, SolvesTheTrunksEndAlone) {
  RandomFork fork(3, {{0, 1}, {2}}, 3);
  BlockTridiagonal& trunk = fork.trunk.chain;
  TridiagonalFactors factors;
  factors.resize(trunk.elements, trunk.roll_count);
  ForkBranch* branches[] = {&fork.branches[0], &fork.branches[1]};
  solve_fork(trunk, factors, branches, 0.5);
  std::mt19937 random(1);
  std::normal_distribution<> normal;
  for (int round = 0; round < 4; ++round) {
    // What a tie to a wall changes: a gap of a branch, the trunk's last gap and its last node's compliance.
    for (int c = 0; c < 3; ++c) {
      fork.chains[0]->chain.gap.at(c)[2] += normal(random);
      trunk.gap.at(c)[trunk.elements - 1] += normal(random);
    }
    store6(trunk.compliance, trunk.elements, 0.9 * load6<double>(trunk.compliance, trunk.elements));
    ASSERT_TRUE(solve_fork(trunk, factors, branches, 0.5, trunk.elements - 4));
    complete(trunk, factors);
    const VectorXd again = fork.solution();
    TridiagonalFactors others;
    others.resize(trunk.elements, trunk.roll_count);
    solve_fork(trunk, others, branches, 0.5);
    const VectorXd whole = fork.solution();
    EXPECT_LT((again - whole).norm(), 1e-9 * whole.norm()) << round;
  }
}

}  // namespace
}  // namespace ostium::core
