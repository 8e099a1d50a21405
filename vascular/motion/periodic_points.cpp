#include "vascular/motion/periodic_points.h"

#include <cassert>
#include <cmath>

#include "core/base/parallel_loop.h"
#include "vascular/geometry/implicit/spline.h"

namespace ostium::vascular {

PeriodicPoints::PeriodicPoints(const std::vector<std::vector<Eigen::Vector3d>>& frames)
    : frames_(static_cast<int>(frames.size())) {
  assert(frames_ >= 4);
  const Eigen::MatrixXd to_coefficients = periodic_b_spline(Eigen::MatrixXd::Identity(frames_, frames_));
  const std::size_t points = frames.front().size(), n = static_cast<std::size_t>(frames_);
  mean_.resize(points);
  offsets_.resize(points * n * 3);
  core::in_parallel(points, [&](std::size_t begin, std::size_t end) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> path(frames_, 3);
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t f = 0; f < n; ++f) path.row(static_cast<Eigen::Index>(f)) = frames[f][i].transpose();
      mean_[i] = path.colwise().mean().transpose();
      const Eigen::Matrix<double, Eigen::Dynamic, 3> c = to_coefficients * (path.rowwise() - mean_[i].transpose());
      for (std::size_t f = 0; f < n; ++f)
        for (int axis = 0; axis < 3; ++axis)
          offsets_[(i * n + f) * 3 + static_cast<std::size_t>(axis)] =
              static_cast<float>(c(static_cast<Eigen::Index>(f), axis));
    }
  });
}

PeriodicPoints::Moment PeriodicPoints::moment_from(int first, const Eigen::Vector4d& weights) const {
  return {{first % frames_, (first + 1) % frames_, (first + 2) % frames_, (first + 3) % frames_}, weights};
}

Eigen::Vector3d PeriodicPoints::blended(std::size_t i, const Moment& moment) const {
  const float* const own = &offsets_[i * static_cast<std::size_t>(frames_) * 3];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 4; ++k)
    sum += moment.weights[static_cast<Eigen::Index>(k)] *
           Eigen::Map<const Eigen::Vector3f>(own + 3 * moment.frames[k]).cast<double>();
  return sum;
}

PeriodicPoints::Moment PeriodicPoints::moment(double phase) const {
  const double u = (phase - std::floor(phase)) * frames_;
  const int f = static_cast<int>(u) % frames_;
  return moment_from(f + frames_ - 1, b_spline_weights(u - std::floor(u)));
}

Eigen::Vector3d PeriodicPoints::velocity(std::size_t i, double phase) const {
  const double u = (phase - std::floor(phase)) * frames_;
  const int f = static_cast<int>(u) % frames_;
  return frames_ * blended(i, moment_from(f + frames_ - 1, b_spline_slopes(u - std::floor(u))));
}

std::vector<std::vector<Eigen::Vector3d>> resampled(const std::vector<std::vector<Eigen::Vector3d>>& frames,
                                                    int count) {
  if (static_cast<int>(frames.size()) == count) return frames;
  const PeriodicPoints points(frames);
  std::vector<std::vector<Eigen::Vector3d>> out(static_cast<std::size_t>(count), frames.front());
  for (int f = 1; f < count; ++f)
    for (std::size_t i = 0; i < points.size(); ++i)
      out[static_cast<std::size_t>(f)][i] = points.position(i, static_cast<double>(f) / count);
  return out;
}

}  // namespace ostium::vascular
