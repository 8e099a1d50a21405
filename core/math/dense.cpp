#include "core/math/dense.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace ostium::core {

using Eigen::MatrixXd, Eigen::VectorXd;

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) { return A.colPivHouseholderQr().solve(b); }

MatrixXd least_squares_of_columns(const MatrixXd& A, const MatrixXd& B) { return A.colPivHouseholderQr().solve(B); }

VectorXd solve_symmetric(const MatrixXd& A, const VectorXd& b) { return A.ldlt().solve(b); }

MatrixXd inverse_of_symmetric(const MatrixXd& A) {
  return A.ldlt().solve(MatrixXd(MatrixXd::Identity(A.rows(), A.cols())));
}

double log_determinant_of_symmetric(const MatrixXd& A) { return A.ldlt().vectorD().array().max(1e-300).log().sum(); }

SymmetricEigen eigen_of_symmetric(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

MatrixXd pseudo_inverse_of_symmetric(const MatrixXd& A) {
  if (A.size() == 0) return A;
  const SymmetricEigen e = eigen_of_symmetric(A);
  const double rounding =
      std::numeric_limits<double>::epsilon() * static_cast<double>(A.rows()) * e.values.cwiseAbs().maxCoeff();
  VectorXd over = VectorXd::Zero(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (std::fabs(e.values[i]) > rounding) over[i] = 1 / e.values[i];
  return e.vectors * over.asDiagonal() * e.vectors.transpose();
}

MatrixXd cholesky(const MatrixXd& A) { return A.llt().matrixL(); }

MatrixXd solve_lower(const MatrixXd& L, const MatrixXd& B) { return L.triangularView<Eigen::Lower>().solve(B); }

MatrixXd inverse(const MatrixXd& A) { return A.inverse(); }

MatrixXd orthonormal(const MatrixXd& A) {
  return A.householderQr().householderQ() * MatrixXd::Identity(A.rows(), A.cols());
}

MatrixXd orthonormal_of_range(const MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  return MatrixXd(qr.householderQ()).leftCols(qr.rank());
}

VectorXd perpendicular_to_columns(const MatrixXd& A) {
  return MatrixXd(A.householderQr().householderQ()).rightCols<1>();
}

MatrixXd principal_directions(const MatrixXd& A) {
  return eigen_of_symmetric(A.transpose() * A).vectors.rowwise().reverse();
}

}  // namespace ostium::core
