#pragma once
/// Factorisations of dense matrices of any size, compiled once: each of Eigen's takes its includer up to half a minute
/// of compilation. Matrices are finite; what is singular is said at each. Any thread.
#include <Eigen/Core>

namespace ostium::core {

/// x of least |A x - b|, by QR with column pivoting; A has full column rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// The same for each column of B.
Eigen::MatrixXd least_squares_of_columns(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// x of A x = b, A symmetric and definite, by L D L^T.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// The inverse of such a matrix.
Eigen::MatrixXd inverse_of_symmetric(const Eigen::MatrixXd& A);
/// The logarithm of its determinant; directions without extent count as 1e-300.
double log_determinant_of_symmetric(const Eigen::MatrixXd& A);
/// Moore-Penrose inverse of a symmetric matrix: directions with eigenvalues below rounding are left out.
Eigen::MatrixXd pseudo_inverse_of_symmetric(const Eigen::MatrixXd& A);
/// Eigenvalues in increasing order, and their vectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen eigen_of_symmetric(const Eigen::MatrixXd& A);

/// Cholesky's L of A = L L^T, A symmetric and positive definite.
Eigen::MatrixXd cholesky(const Eigen::MatrixXd& A);
/// X of L X = B, L lower triangular.
Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B);

/// The inverse of a square matrix, by L U with partial pivoting.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);

/// As many orthonormal columns as A has, the same span; A (n, m) has rank m <= n.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A);
/// As many orthonormal columns as A has rank, the same span.
Eigen::MatrixXd orthonormal_of_range(const Eigen::MatrixXd& A);
/// The unit vector perpendicular to all columns of A (n, n - 1), of rank n - 1.
Eigen::VectorXd perpendicular_to_columns(const Eigen::MatrixXd& A);
/// Directions in which the rows of A (n, m), n >= m, scatter about 0, as columns, the widest first (m, m).
Eigen::MatrixXd principal_directions(const Eigen::MatrixXd& A);

}  // namespace ostium::core
