#pragma once
/// Motion of points of the heart as the ventricles contract.
///
/// Amplitudes: the mean left ventricle of 2,291 people at end-diastole and end-systole (Cardiac Atlas Project, clinical
/// cohorts), by fraction of the axis, with the apex at rest: the groove moves 10.6 mm towards the apex, the wall 3.8 to
/// 1.4 mm towards the axis. From memory, to be verified: the lateral groove 12 to 16 mm (MAPSE), the right one 20 to 25
/// mm (TAPSE), a twist of 8 to 14 degrees. The atlas does not give the motion of the heart as a whole: its shift is
/// chosen so that left main and LAD are as fast as in electron beam CT (Mao 2000); its direction is an estimate.
#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

class HeartMotion {
 public:
  explicit HeartMotion(const Landmarks& landmarks) : marks_(landmarks) {}

  /// Displacement, m, at end-systole of a point that is at `p` at end-diastole. In between, every point moves there and
  /// back along a straight line, following heart_cycle.h's contraction.
  Eigen::Vector3d displacement(const Eigen::Vector3d& p) const;

  /// Displacement of the aortic root as a whole.
  Eigen::Vector3d root_displacement() const;

  /// Displacement of the heart by a breath of that depth (Shechter 2004: 4.9 mm down, 1.3 mm forward, tilted by 1.5
  /// degrees).
  Eigen::Vector3d breath_displacement(const Eigen::Vector3d& p, double depth) const;

 private:
  Landmarks marks_;
};

/// 0 below `low`, 1 above `high`, twice continuously differentiable between.
double smooth_step(double low, double high, double x);

}  // namespace ostium::vascular
