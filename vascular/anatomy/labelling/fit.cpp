#include "vascular/anatomy/labelling/fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostium::vascular {

Similarity nearest_similarity(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  const Eigen::Index n = static_cast<Eigen::Index>(from.size());
  Eigen::MatrixXd a(3, n), b(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    a.col(i) = from[static_cast<std::size_t>(i)];
    b.col(i) = to[static_cast<std::size_t>(i)];
  }
  const Eigen::Matrix4d T = Eigen::umeyama(a, b, true);
  Similarity fit;
  fit.scale = std::cbrt(T.topLeftCorner<3, 3>().determinant());
  fit.R = T.topLeftCorner<3, 3>() / fit.scale;
  fit.shift = T.topRightCorner<3, 1>();
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) sum += (fit * from[i] - to[i]).squaredNorm();
  fit.rms_m = std::sqrt(sum / static_cast<double>(from.size()));
  return fit;
}

Eigen::Matrix3d nearest_axes(const Eigen::Matrix3d& R, double* angle_rad) {
  Eigen::Matrix3d best = Eigen::Matrix3d::Identity();
  double most = -4;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) axes(i, order[static_cast<std::size_t>(i)]) = signs >> i & 1 ? -1 : 1;
      if (axes.determinant() < 0) continue;
      if (const double trace = (axes.transpose() * R).trace(); trace > most) most = trace, best = axes;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  if (angle_rad) *angle_rad = std::acos(std::clamp((most - 1) / 2, -1.0, 1.0));
  return best;
}

}  // namespace ostium::vascular
