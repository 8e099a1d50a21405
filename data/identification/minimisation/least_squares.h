#pragma once
/// Nonlinear least squares with bounds (Ceres Solver, trust region).
#include <Eigen/Core>
#include <functional>
#include <optional>

namespace ostium::data {

struct LeastSquares {
  int residuals = 0;
  Eigen::VectorXd start, least, most;
  double tolerance = 1e-8;  ///< relative, on cost and step
  int most_iterations = 60;
  /// Computes the residuals at x and, if not null, their Jacobian; false if there is no solution.
  std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian)> evaluate;
};

struct LeastSquaresResult {
  bool converged = false;
  int iterations = 0;
  double cost = 0;  ///< half the sum of squares
  Eigen::VectorXd x;
};

LeastSquaresResult minimise(const LeastSquares& problem);

}  // namespace ostium::data
