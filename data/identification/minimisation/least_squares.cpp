#include "data/identification/minimisation/least_squares.h"

#include <ceres/ceres.h>

namespace ostium::data {

namespace {

/// Keeps the last evaluation: where there are bounds Ceres looks along a line first, with the derivatives, and then
/// asks for the same place twice more.
class Cost : public ceres::CostFunction {
 public:
  explicit Cost(const LeastSquares& problem) : problem_(problem) {
    set_num_residuals(problem.residuals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.start.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(parameters[0], problem_.start.size());
    const bool wants = jacobians && jacobians[0];
    if (x_.size() != x.size() || x_ != x || (wants && !has_J_)) {
      x_.resize(0);
      if (!problem_.evaluate(x, r_, wants ? &J_ : nullptr)) return false;
      x_ = x, has_J_ = wants;
    }
    Eigen::Map<Eigen::VectorXd>(residuals, r_.size()) = r_;
    if (wants)
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobians[0], J_.rows(),
                                                                                         J_.cols()) = J_;
    return true;
  }

 private:
  const LeastSquares& problem_;
  mutable Eigen::VectorXd x_, r_;
  mutable Eigen::MatrixXd J_;
  mutable bool has_J_ = false;
};

}  // namespace

LeastSquaresResult minimise(const LeastSquares& problem) {
  LeastSquaresResult out;
  out.x = problem.start;
  if (out.x.size() == 0) {  // Ceres takes no empty block
    Eigen::VectorXd r;
    out.converged = problem.evaluate(out.x, r, nullptr);
    out.cost = r.squaredNorm() / 2;
    return out;
  }
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new Cost(problem), nullptr, out.x.data());
  for (int i = 0; i < out.x.size(); ++i) {
    ceres_problem.SetParameterLowerBound(out.x.data(), i, problem.least[i]);
    ceres_problem.SetParameterUpperBound(out.x.data(), i, problem.most[i]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = problem.most_iterations;
  options.function_tolerance = problem.tolerance;
  options.parameter_tolerance = problem.tolerance;
  options.gradient_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  out.converged = summary.termination_type == ceres::CONVERGENCE;
  out.iterations = static_cast<int>(summary.iterations.size());
  out.cost = summary.final_cost;
  return out;
}

}  // namespace ostium::data
