#pragma once
/// Where a point of the heart goes as the ventricles contract.
///
/// Amplitudes: the mean left ventricle of 2,291 people at end-diastole and end-systole (Cardiac Atlas Project, clinical
/// cohorts), by fraction of the axis, with the apex at rest: the groove moves 10.6 mm towards the apex, the wall 3.8
/// to 1.4 mm towards the axis. From memory, to be verified: the lateral groove 12 to 16 mm (MAPSE), the right one 20 to
/// 25 mm (TAPSE), a twist of 8 to 14 degrees. The atlas does not say how the heart moves as a whole: it is shifted by
/// as much as left main and LAD need to be as fast as in electron beam CT (Mao 2000), its direction is an estimate.
#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

class HeartMotion {
 public:
  explicit HeartMotion(const Landmarks& landmarks) : marks_(landmarks) {}

  /// Displacement in metres, at end-systole, of a point that is at `p` at end-diastole. Between, every point goes there
  /// and back along a straight line, by heart_cycle.h's contraction.
  Eigen::Vector3d displacement(const Eigen::Vector3d& p) const;

  /// Of the aortic root as a whole.
  Eigen::Vector3d root_displacement() const;

  /// The heart in a breath of that depth (Shechter 2004: 4.9 mm down, 1.3 mm forward, tilted by 1.5 degrees).
  Eigen::Vector3d breath_displacement(const Eigen::Vector3d& p, double depth) const;

 private:
  Landmarks marks_;
};

/// 0 below `low`, 1 above `high`, twice continuously differentiable between.
double smooth_step(double low, double high, double x);

}  // namespace ostium::vascular
