#pragma once
/// The aortic root and the frame in which the coronary arteries are described.
#include <Eigen/Geometry>

#include "vascular/anatomy/parameters.h"

namespace ostium::vascular {

/// Positions of both ostia and the annulus. The root's axis is at 48 degrees to the vertical, such that the annulus is
/// seen edge-on in LAO 10, AP/CAU 11 and RAO 15/CAU 25. The ostia are 14.4 (left) and 18.2 mm (right) above the annulus
/// (14.4 +- 2.9 and 17.2 +- 3.3: Tops 2008), 136 degrees apart, in the direction of Dodge's mean vector between them,
/// shortened to fit the sinus.
struct Root {
  Eigen::Vector3d p_annulus, p_left_ostium, p_right_ostium;  ///< patient frame, metres
  Eigen::Vector3d p_middle;                                  ///< of the sinuses, on the axis at the left ostium
  Eigen::Vector3d axis, to_left, to_right, to_noncoronary;   ///< unit vectors
  Eigen::Matrix3d heart;                                     ///< rotates and scales the mean heart to this one

  /// From mean-heart coordinates, mm from the left (right) ostium, to the patient frame.
  Eigen::Vector3d from_left(const Eigen::Vector3d& p_mm) const { return p_left_ostium + heart * p_mm * 1e-3; }
  Eigen::Vector3d from_right(const Eigen::Vector3d& p_mm) const { return p_right_ostium + heart * p_mm * 1e-3; }
};

Root make_root(const AnatomyParameters& parameters);

}  // namespace ostium::vascular
