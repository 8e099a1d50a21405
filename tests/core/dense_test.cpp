/// Dense factorisations against their definitions, on matrices of a fixed generator.
#include "core/math/dense.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/math/alignment.h"
#include "tests/support/dice.h"

namespace ostium::core {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

MatrixXd drawn(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  synthetic::Dice dice("dense", seed);
  MatrixXd A(rows, columns);
  for (Eigen::Index i = 0; i < A.size(); ++i) A(i) = dice.normals().x();
  return A;
}

TEST(Dense, LeastSquaresLeavesAnOrthogonalRest) {
  const MatrixXd A = drawn(9, 4, 1), B = drawn(9, 3, 2);
  EXPECT_LT((A.transpose() * (A * least_squares(A, B.col(0)) - B.col(0))).norm(), 1e-12);
  EXPECT_LT((A.transpose() * (A * least_squares_of_columns(A, B) - B)).norm(), 1e-12);
}

TEST(Dense, SymmetricMatrices) {
  const MatrixXd half = drawn(6, 6, 3), A = half * half.transpose();
  const VectorXd b = drawn(6, 1, 4);
  EXPECT_LT((A * solve_symmetric(A, b) - b).norm(), 1e-9);
  EXPECT_LT((A * inverse_of_symmetric(A) - MatrixXd::Identity(6, 6)).norm(), 1e-9);
  EXPECT_NEAR(log_determinant_of_symmetric(A), 2 * std::log(std::fabs(half.determinant())), 1e-9);
  const MatrixXd L = cholesky(A);
  EXPECT_LT((L * L.transpose() - A).norm(), 1e-12);
  EXPECT_LT((L * solve_lower(L, half) - half).norm(), 1e-12);
  const SymmetricEigen e = eigen_of_symmetric(A);
  EXPECT_LT((A * e.vectors - e.vectors * e.values.asDiagonal()).norm(), 1e-11);
  EXPECT_LE(e.values[0], e.values[5]);
}

/// The four conditions of Penrose 1955, for a matrix of rank 3.
TEST(Dense, PseudoInverse) {
  const MatrixXd half = drawn(5, 3, 5), A = half * half.transpose(), P = pseudo_inverse_of_symmetric(A);
  EXPECT_LT((A * P * A - A).norm(), 1e-11);
  EXPECT_LT((P * A * P - P).norm(), 1e-11);
  EXPECT_LT((A * P - (A * P).transpose()).norm(), 1e-11);
  EXPECT_LT((P * A - (P * A).transpose()).norm(), 1e-11);
  EXPECT_EQ(pseudo_inverse_of_symmetric(MatrixXd::Zero(2, 2)), MatrixXd::Zero(2, 2));
}

TEST(Dense, SpansAndDirections) {
  const MatrixXd A = drawn(7, 3, 6), Q = orthonormal(A);
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(3, 3)).norm(), 1e-13);
  EXPECT_LT((Q * Q.transpose() * A - A).norm(), 1e-12);
  MatrixXd twice(7, 6);
  twice << A, 2 * A;
  const MatrixXd range = orthonormal_of_range(twice);
  ASSERT_EQ(range.cols(), 3);
  EXPECT_LT((range * range.transpose() * A - A).norm(), 1e-12);
  const MatrixXd four = drawn(5, 4, 7);
  const VectorXd across = perpendicular_to_columns(four);
  EXPECT_NEAR(across.norm(), 1, 1e-13);
  EXPECT_LT((four.transpose() * across).norm(), 1e-12);
  const MatrixXd square = drawn(4, 4, 8);
  EXPECT_LT((square * inverse(square) - MatrixXd::Identity(4, 4)).norm(), 1e-11);
  const MatrixXd wide = drawn(30, 3, 9) * Vector3d(1, 5, 0.2).asDiagonal();
  const MatrixXd V = principal_directions(wide);
  EXPECT_GT((wide * V.col(0)).norm(), (wide * V.col(1)).norm());
  EXPECT_GT((wide * V.col(1)).norm(), (wide * V.col(2)).norm());
  EXPECT_LT(std::fabs((wide * V.col(0)).dot(wide * V.col(1))), 1e-9);
}

TEST(Alignment, NearestRotationTurnsPointsBack) {
  const Matrix3d R = (Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.5).normalized())).toRotationMatrix();
  for (const Vector3d& flat : {Vector3d(1, 1, 1), Vector3d(1, 1, 0)}) {  // a flat set of points, too
    Matrix3d M = Matrix3d::Zero();
    for (unsigned k = 0; k < 5; ++k) {
      const Vector3d p = drawn(3, 1, 20 + k).col(0).cwiseProduct(flat);
      M += (R * p) * p.transpose();
    }
    EXPECT_LT((nearest_rotation(M) - R).norm(), 1e-12);
    EXPECT_NEAR(nearest_rotation(-M).determinant(), 1, 1e-12);
  }
}

TEST(Alignment, RotationBetween) {
  const Vector3d a(1, 2, -0.5), b(-0.3, 0.1, 2);
  EXPECT_LT((rotation_between(a, b) * a.normalized() - b.normalized()).norm(), 1e-14);
  EXPECT_LT((rotation_between(a, b) * a.cross(b) - a.cross(b)).norm(), 1e-14);  // the shortest
  EXPECT_LT((rotation_between(a, -3 * a) * a + a).norm(), 1e-7);
}

}  // namespace
}  // namespace ostium::core
