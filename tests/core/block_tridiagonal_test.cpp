#include "core/solver/block_tridiagonal.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "core/base/tolerances.h"

namespace ostium::core {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A random chain and the same system as a dense matrix.
struct RandomChain {
  RandomChain(int N, unsigned seed, double softening = 0, int rolls = 0)
      : chain(N, rolls), matrix(MatrixXd::Zero((6 + rolls) * N, (6 + rolls) * N)), right((6 + rolls) * N) {
    std::mt19937 generator(seed);
    std::normal_distribution<> normal;
    const auto vector = [&]() -> Vector3d { return {normal(generator), normal(generator), normal(generator)}; };
    const auto spd = [&] {
      Matrix3d a;
      a << vector(), vector(), vector();
      return Matrix3d(a * a.transpose());
    };
    const auto six = [](const Matrix3d& m) {
      Eigen::Matrix<double, 6, 1> v;
      v << m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2);
      return v;
    };
    const auto cross = [](const Vector3d& d) {
      Matrix3d m;
      m << 0, -d.z(), d.y(), d.z(), 0, -d.x(), -d.y(), d.x(), 0;
      return m;
    };
    std::vector<Matrix3d> P, H;
    std::vector<Vector3d> m;
    for (int i = 0; i <= N; ++i) {
      P.push_back(i == 0 ? Matrix3d(Matrix3d::Zero()) : spd());  // the base is held
      H.push_back(spd());
      m.push_back(vector());
      chain.compliance.set(i, six(P[i]));
      chain.joint_stiffness.set(i, six(H[i]));
      chain.joint_moment.set(i, m[i]);
    }
    for (int j = 0; j < N; ++j) {
      const Matrix3d K = H[j] + H[j + 1] + 3 * spd() - softening * Matrix3d::Identity();
      const Vector3d d = vector(), torque = vector(), gap = vector();
      chain.stiffness.set(j, six(K));
      chain.arm.set(j, d);
      chain.torque.set(j, torque);
      chain.gap.set(j, gap);
      const int at = 6 * j;
      matrix.block<3, 3>(at, at) = K;
      matrix.block<3, 3>(at, at + 3) = -cross(d);
      matrix.block<3, 3>(at + 3, at) = cross(d);
      matrix.block<3, 3>(at + 3, at + 3) = -(P[j] + P[j + 1] + tolerances::axial_give_per_N_m * d * d.transpose());
      if (j + 1 < N) {
        matrix.block<3, 3>(at, at + 6) = -H[j + 1] + 0.5 * cross(m[j + 1]);
        matrix.block<3, 3>(at + 3, at + 9) = P[j + 1];
      }
      if (j > 0) {
        matrix.block<3, 3>(at, at - 6) = -H[j] - 0.5 * cross(m[j]);
        matrix.block<3, 3>(at + 3, at - 3) = P[j];
      }
      right.segment<3>(at) = torque;
      right.segment<3>(at + 3) = gap;
    }
    const auto couple = [&](int a, int b, double c) { matrix(a, b) = matrix(b, a) = c; };
    for (int n = 0; n < rolls; ++n) {
      Roll& roll = chain.rolls[n];
      const auto at = [&](int j) { return 6 * N + n * N + j; };
      for (int j = 0; j < N; ++j) {
        const Vector3d b = vector();
        roll.stiffness.at(0)[j] = matrix(at(j), at(j)) = 40;
        roll.with_turn.set(j, b);
        for (int k = 0; k < 3; ++k) couple(6 * j + k, at(j), b[k]);
        roll.torque.at(0)[j] = right[at(j)] = normal(generator);
        if (n > 0) couple(at(j) - N, at(j), roll.beside.at(0)[j] = normal(generator));
        if (j == 0) continue;
        const Vector3d u = vector(), w = vector();
        roll.ahead.set(j, u), roll.behind.set(j, w);
        for (int k = 0; k < 3; ++k) couple(6 * (j - 1) + k, at(j), u[k]), couple(at(j - 1), 6 * j + k, w[k]);
        couple(at(j - 1), at(j), roll.both.at(0)[j] = normal(generator));
      }
    }
  }

  VectorXd solution() const {
    VectorXd x(right.size());
    const int N = chain.elements;
    for (int j = 0; j < N; ++j) {
      x.segment<3>(6 * j) = chain.turn[j], x.segment<3>(6 * j + 3) = chain.force[j];
      for (std::size_t m = 0; m < chain.rolls.size(); ++m)
        x[6 * N + static_cast<int>(m) * N + j] = chain.rolls[m].turn.at(0)[j];
    }
    return x;
  }
  double relative_error() const {
    const VectorXd exact = matrix.fullPivLu().solve(right);
    return (solution() - exact).norm() / exact.norm();
  }

  BlockTridiagonal chain;
  MatrixXd matrix;
  VectorXd right;
};

TridiagonalFactors factors_for(int elements, int rolls = 0) {
  TridiagonalFactors f;
  f.resize(elements, rolls);
  return f;
}

TEST(BlockTridiagonal, SolvesWhatADenseSolverSolves) {
  for (int N : {16, 17, 30, 33}) {
    RandomChain random(N, N);
    ASSERT_LT((random.matrix - random.matrix.transpose()).norm(), 1e-12);
    TridiagonalFactors factors = factors_for(N);
    solve(random.chain, nullptr, factors);
    EXPECT_LT(random.relative_error(), 1e-8) << N;
  }
}

TEST(BlockTridiagonal, SolvesRollsWithTheTurns) {
  for (int rolls : {1, 2, 3})
    for (int N : {16, 33}) {
      RandomChain random(N, 7 * N, 0, rolls);
      ASSERT_LT((random.matrix - random.matrix.transpose()).norm(), 1e-12);
      TridiagonalFactors factors = factors_for(N, rolls);
      solve(random.chain, nullptr, factors);
      EXPECT_LT(random.relative_error(), 1e-8) << rolls << " rolls, " << N;
    }
}

TEST(BlockTridiagonal, ARollWithNegativeStiffnessIsNotDefinite) {
  RandomChain random(20, 5, 0, 2);
  TridiagonalFactors factors = factors_for(20, 2);
  random.chain.rolls[1].stiffness.at(0)[7] = -100;
  solve(random.chain, nullptr, factors);
  EXPECT_FALSE(random.chain.definite);
}

TEST(BlockTridiagonal, SolutionDoesNotDependOnItsCompany) {
  for (int other : {16, 31, 64}) {
    RandomChain alone(33, 1), together(33, 1), company(other, 2);
    TridiagonalFactors factors = factors_for(64);
    solve(alone.chain, nullptr, factors);
    solve(together.chain, &company.chain, factors);
    EXPECT_EQ(alone.solution(), together.solution()) << other;
    EXPECT_LT(company.relative_error(), 1e-8);
    solve(company.chain, &together.chain, factors);
    EXPECT_EQ(alone.solution(), together.solution()) << other;
  }
}

TEST(BlockTridiagonal, SolvedWithinAStretchIsAsSolvedWhole) {
  for (int rolls : {0, 2})
    for (int N : {16, 47, 64})
      for (int first : {0, N / 4})
        for (int from = (first + N) / 2 + 1; from < N; from += 3)
          for (int to : {from, std::min(from + 6, N - 1), N - 1}) {
            RandomChain within(N, 1, 0, rolls), whole(N, 1, 0, rolls);
            TridiagonalFactors factors = factors_for(N, rolls), others = factors_for(N, rolls);
            within.chain.first = whole.chain.first = first;
            solve(within.chain, nullptr, factors);
            for (int node = from + 1; node <= to; ++node) {  // one after the other, as ties are
              for (RandomChain* random : {&within, &whole}) {
                for (int k : {0, 3, 5}) random->chain.compliance.at(k)[node] += 1;
                random->chain.gap.at(1)[node - 1] += 1;
                random->chain.gap.at(1)[node] -= 1;
              }
              ASSERT_TRUE(solve_within(within.chain, from, to, factors));
              solve(whole.chain, nullptr, others);
              for (int j = from; j <= to; ++j)
                ASSERT_LT((within.chain.force[j] - whole.chain.force[j]).norm(),
                          1e-9 * (1 + whole.chain.force[j].norm()))
                    << rolls << " rolls, " << from << " to " << to << " of " << N << " at " << j;
              EXPECT_EQ(within.chain.definite, whole.chain.definite);
            }
            if (to == from) continue;
            complete(within.chain, factors);
            for (int j = first; j < N; ++j) {
              ASSERT_LT((within.chain.force[j] - whole.chain.force[j]).norm(),
                        1e-9 * (1 + whole.chain.force[j].norm()));
              ASSERT_LT((within.chain.turn[j] - whole.chain.turn[j]).norm(), 1e-9 * (1 + whole.chain.turn[j].norm()));
            }
          }
  RandomChain short_of_it(16, 1, 0, 0);
  TridiagonalFactors factors = factors_for(16);
  solve(short_of_it.chain, nullptr, factors);
  EXPECT_FALSE(solve_within(short_of_it.chain, 8, 12, factors)) << "the middle itself";
}

TEST(BlockTridiagonal, SolvedAgainFromWhereItChangedIsAsSolvedAnew) {
  for (int rolls : {0, 2})
    for (int N : {3, 16, 47, 64})
      for (int first : {0, N / 4})
        for (int node = first + 1; node <= N; ++node) {
          if (N - first < 3) continue;
          RandomChain again(N, 1, 0, rolls), anew(N, 1, 0, rolls);
          TridiagonalFactors factors = factors_for(N, rolls), others = factors_for(N, rolls);
          again.chain.first = anew.chain.first = first;
          solve(again.chain, nullptr, factors);
          for (double more : {1.0, 2.0}) {
            for (RandomChain* random : {&again, &anew}) {
              for (int k : {0, 3, 5}) random->chain.compliance.at(k)[node] += more;
              random->chain.gap.at(1)[node - 1] += more;
              if (node < N) random->chain.gap.at(1)[node] -= more;
            }
            solve_again(again.chain, std::max(0, std::min(node - 1 - first, N - 1 - node)), factors);
            solve(anew.chain, nullptr, others);
            ASSERT_EQ(again.solution(), anew.solution())
                << rolls << " rolls, " << node << " of " << first << " to " << N;
          }
        }
}

TEST(BlockTridiagonal, CountsNegativeDirectionsLikeEigenvalues) {
  for (double softening : {0.0, 3.0, 8.0, 20.0}) {
    RandomChain random(20, 5, softening);
    TridiagonalFactors factors = factors_for(20);
    solve(random.chain, nullptr, factors);
    const VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(random.matrix, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_EQ(negative_pivots(random.chain, factors), (eigenvalues.array() < 0).count() - 3 * 20) << softening;
  }
}

}  // namespace
}  // namespace ostium::core
