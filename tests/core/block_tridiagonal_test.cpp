#include "core/solver/block_tridiagonal.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/core/random_chain.h"

namespace ostium::core {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

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
  for (int rolls : {1, 2, 3, 4})
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
