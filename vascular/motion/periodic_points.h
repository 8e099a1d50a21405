#pragma once
/// Points that run through the same path every cycle: 24 frames (or any number), between them a periodic cubic
/// B-spline, so that velocity and acceleration are continuous. Each point is evaluated on its own, so only those asked
/// for cost time.
#include <Eigen/Core>
#include <vector>

namespace ostium::vascular {

constexpr int beat_frames = 24;

class PeriodicPoints {
 public:
  PeriodicPoints() = default;
  /// frames[f][i]: place of point i at phase f / #frames. All frames have as many points. Single precision about the
  /// mean: a path of 30 mm is kept to 2 nm.
  explicit PeriodicPoints(const std::vector<std::vector<Eigen::Vector3d>>& frames);

  std::size_t size() const { return mean_.size(); }
  int frames() const { return frames_; }
  Eigen::Vector3d position(std::size_t i, double phase) const;
  /// d position / d phase.
  Eigen::Vector3d velocity(std::size_t i, double phase) const;
  std::size_t memory() const { return offsets_.size() * sizeof(float) + mean_.size() * sizeof(Eigen::Vector3d); }

 private:
  Eigen::Vector3d blended(std::size_t i, int first, const Eigen::Vector4d& weights) const;

  int frames_ = 0;
  std::vector<Eigen::Vector3d> mean_;
  std::vector<float> offsets_;  ///< spline coefficients, point by frame by axis
};

/// Frames of another number, evenly spaced from the first on, of points that are given in at least four.
std::vector<std::vector<Eigen::Vector3d>> resampled(const std::vector<std::vector<Eigen::Vector3d>>& frames, int count);

}  // namespace ostium::vascular
