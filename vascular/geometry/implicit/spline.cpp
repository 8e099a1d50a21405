#include "vascular/geometry/implicit/spline.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>

#include "core/math/dense.h"

namespace ostium::vascular {

CurveSpline::CurveSpline(const std::vector<Eigen::Vector3d>& points) : points_(points) {
  const std::size_t n = points.size();
  assert(n >= 2);
  knots_.push_back(0);
  for (std::size_t i = 1; i < n; ++i) knots_.push_back(knots_.back() + (points[i] - points[i - 1]).norm());
  // Thomas' algorithm for the second derivatives M: h0 M0 + 2 (h0 + h1) M1 + h1 M2 = 6 (slope1 - slope0).
  second_.assign(n, Eigen::Vector3d::Zero());
  std::vector<double> upper(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = knots_[i] - knots_[i - 1], h1 = knots_[i + 1] - knots_[i];
    assert(h0 > 0 && h1 > 0);
    const double pivot = 2 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    const Eigen::Vector3d right = 6 * ((points[i + 1] - points[i]) / h1 - (points[i] - points[i - 1]) / h0);
    second_[i] = (right - h0 * second_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) second_[i] -= upper[i] * second_[i + 1];
}

Eigen::Vector3d CurveSpline::at(double u) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, u);
  const std::size_t j = static_cast<std::size_t>(above - knots_.begin()), i = j - 1;
  const double h = knots_[j] - knots_[i], b = (u - knots_[i]) / h, a = 1 - b;
  return a * points_[i] + b * points_[j] + h * h / 6 * ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[j]);
}

Eigen::Vector4d b_spline_weights(double t) {
  const double u = 1 - t;
  return Eigen::Vector4d(u * u * u, 3 * t * t * t - 6 * t * t + 4, 3 * u * u * u - 6 * u * u + 4, t * t * t) / 6;
}

Eigen::Vector4d b_spline_slopes(double t) {
  const double u = 1 - t;
  return Eigen::Vector4d(-u * u, 3 * t * t - 4 * t, -3 * u * u + 4 * u, t * t) / 2;
}

Eigen::MatrixXd periodic_b_spline(const Eigen::MatrixXd& values) {
  const Eigen::Index n = values.rows();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, i) += 4.0 / 6;
    A(i, (i + 1) % n) += 1.0 / 6;
    A(i, (i + n - 1) % n) += 1.0 / 6;
  }
  return core::inverse(A) * values;  // well conditioned: condition number at most 3
}

}  // namespace ostium::vascular
