#pragma once
/// Points that repeat the same path every cycle: 24 frames (or any number), interpolated by a periodic cubic B-spline,
/// so that velocity and acceleration are continuous. Each point is evaluated separately, so only those needed cost
/// time.
#include <Eigen/Core>
#include <array>
#include <vector>

namespace ostium::vascular {

constexpr int beat_frames = 24;

class PeriodicPoints {
 public:
  PeriodicPoints() = default;
  /// frames[f][i]: position of point i at phase f / #frames. All frames have the same number of points. Stored in
  /// single precision relative to the mean: a path of 30 mm is accurate to 2 nm.
  explicit PeriodicPoints(const std::vector<std::vector<Eigen::Vector3d>>& frames);

  std::size_t size() const { return mean_.size(); }
  int frames() const { return frames_; }
  Eigen::Vector3d position(std::size_t i, double phase) const { return position(i, moment(phase)); }
  /// The same for many points at one phase: what they have in common.
  struct Moment {
    std::array<int, 4> frames;
    Eigen::Vector4d weights;
  };
  Moment moment(double phase) const;
  Eigen::Vector3d position(std::size_t i, const Moment& moment) const { return mean_[i] + blended(i, moment); }
  /// d position / d phase.
  Eigen::Vector3d velocity(std::size_t i, double phase) const;
  std::size_t memory() const { return offsets_.size() * sizeof(float) + mean_.size() * sizeof(Eigen::Vector3d); }

 private:
  Moment moment_from(int first, const Eigen::Vector4d& weights) const;
  Eigen::Vector3d blended(std::size_t i, const Moment& moment) const;

  int frames_ = 0;
  std::vector<Eigen::Vector3d> mean_;
  std::vector<float> offsets_;  ///< spline coefficients, point by frame by axis
};

/// Resamples at a different number of frames, evenly spaced from the first; at least four must be given.
std::vector<std::vector<Eigen::Vector3d>> resampled(const std::vector<std::vector<Eigen::Vector3d>>& frames, int count);

}  // namespace ostium::vascular
