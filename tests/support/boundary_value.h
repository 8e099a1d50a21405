#pragma once
/// An independent solver for nested instruments on one shared centreline, or for a single one: the differential
/// equations of Rucker, Jones, Webster (2010, IEEE Trans Robot 26:769) integrated by adaptive Runge-Kutta steps (GSL,
/// rk8pd) from the base, with the unknowns there found by shooting. Rotation matrices, arc length, no elements: of
/// `core` only its structs are used.
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/material/section.h"

namespace ostium::boundary_value {

struct Tube {
  std::vector<core::Section> sections;  ///< from its tip; of several tubes linear, EI1 = EI2, untwisted at rest
  double inserted_m = 0;
  double roll_rad = 0;
  double shaft_rad_per_Nm = 0;
  /// Of a single tube: curvature beyond rest over the linear one, by the linear one (1/m); empty: linear, or softening.
  std::function<double(double)> more_curved = {};
};

/// A point force on the centreline, or a force spread over a stretch.
struct Load {
  double from_base_m = 0, to_base_m = 0;            ///< equal: a point force
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, total over the stretch
};

struct Problem {
  std::vector<Tube> tubes;  ///< outermost first
  Eigen::Vector3d base_p = Eigen::Vector3d::Zero();
  Eigen::Matrix3d base_R = Eigen::Matrix3d::Identity();  ///< unrolled
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  Eigen::Vector3d tip_force = Eigen::Vector3d::Zero();
  std::vector<Load> loads;
};

struct Solution {
  bool converged = false;
  double mismatch = 0;                 ///< residual of the tip's conditions, N m
  std::vector<Eigen::Vector3d> curve;  ///< m, evenly spaced from base to tip
  Eigen::Matrix3d tip_R;               ///< of the last tube
};

/// Starts from the unloaded, uncurved instrument; load and curvature grow in `stages`. `points` along the curve.
Solution solve(const Problem& problem, int points = 201, int stages = 8);

}  // namespace ostium::boundary_value
