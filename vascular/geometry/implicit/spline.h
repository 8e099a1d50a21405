#pragma once
/// Cubic splines, twice continuously differentiable.
#include <Eigen/Core>
#include <vector>

namespace ostium::vascular {

/// Through points in space, with natural ends; the parameter is the cumulative chord length, m.
class CurveSpline {
 public:
  /// At least two points; neighbours must differ.
  explicit CurveSpline(const std::vector<Eigen::Vector3d>& points);

  double end() const { return knots_.back(); }
  const std::vector<double>& knots() const { return knots_; }
  Eigen::Vector3d at(double u) const;  ///< u in [0, end]

 private:
  std::vector<double> knots_;
  std::vector<Eigen::Vector3d> points_, second_;  ///< values and second derivatives at the knots
};

/// Weights of four neighbouring coefficients of a uniform cubic B-spline at fraction t in [0, 1) between the middle
/// two.
Eigen::Vector4d b_spline_weights(double t);
Eigen::Vector4d b_spline_slopes(double t);  ///< d/dt of the weights

/// Coefficients of the periodic uniform cubic B-spline through the rows of `values` (#samples by #quantities).
Eigen::MatrixXd periodic_b_spline(const Eigen::MatrixXd& values);

}  // namespace ostium::vascular
