#include "data/identification/forward/curve.h"

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "core/math/dense.h"

namespace ostium::data {

namespace {
using Eigen::Vector3d;
}

Vector3d nearest_point(const std::vector<Vector3d>& curve, const Vector3d& p) { return nearest_points(curve, {p})[0]; }

std::vector<Vector3d> nearest_points(const std::vector<Vector3d>& curve, const std::vector<Vector3d>& many) {
  const std::size_t last = curve.size() - 2;
  double longest_edge = 0;
  for (std::size_t i = 0; i <= last; ++i) longest_edge = std::max(longest_edge, (curve[i + 1] - curve[i]).norm());
  std::vector<Vector3d> out;
  std::size_t guess = 0;
  for (const Vector3d& p : many) {
    Vector3d best = curve.front();
    double least = std::numeric_limits<double>::infinity();
    std::size_t found = guess;
    const auto look_at = [&](std::size_t i) {
      const Vector3d edge = curve[i + 1] - curve[i];
      double t = (p - curve[i]).dot(edge) / edge.squaredNorm();
      if (i > 0) t = std::max(t, 0.0);
      if (i < last) t = std::min(t, 1.0);
      const Vector3d q = curve[i] + t * edge;
      const double distance = (p - q).norm();
      if (distance < least) least = distance, best = q, found = i;
    };
    // The distance to the last nearest edge bounds the search: from a node that far away, none of the following edges
    // can be nearer. The first and last edges extend to infinity.
    look_at(0), look_at(last), look_at(guess);
    for (std::size_t i = 1; i < last;) {
      const double spare = (p - curve[i]).norm() - least;
      if (spare > longest_edge) {
        i += static_cast<std::size_t>(spare / longest_edge);
        continue;
      }
      look_at(i++);
    }
    out.push_back(best);
    guess = found;
  }
  return out;
}

double radius_of_curvature(const std::vector<Vector3d>& curve) {
  const auto n = static_cast<Eigen::Index>(curve.size());
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : curve) mean += p / static_cast<double>(n);
  Eigen::MatrixXd off(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) off.row(i) = (curve[i] - mean).transpose();
  const double size = off.rowwise().norm().maxCoeff();
  // |q|^2 = 2 c q + d in the plane of the curve (Kasa 1976): exact for the noiseless arcs it is used on.
  const Eigen::MatrixXd q = off * core::principal_directions(off).leftCols(2) / size;
  if (q.col(1).cwiseAbs().maxCoeff() < 1e-9) return std::numeric_limits<double>::infinity();
  Eigen::MatrixXd A(n, 3);
  A << 2 * q, Eigen::VectorXd::Ones(n);
  const Vector3d c = core::least_squares(A, q.rowwise().squaredNorm());
  return size * std::sqrt(c[2] + c.head<2>().squaredNorm());
}

}  // namespace ostium::data
