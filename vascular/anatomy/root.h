#pragma once
/// The aortic root and the frame in which the heart's arteries are described.
#include <Eigen/Geometry>

#include "vascular/anatomy/parameters.h"

namespace ostium::vascular {

/// Where both ostia and the annulus are. The root's axis makes 48 degrees with the vertical and lies so that the
/// annulus is seen edge-on in LAO 10, AP/CAU 11 and RAO 15/CAU 25; the ostia are 14.4 (left) and 18.2 mm (right) above
/// the annulus (14.4 +- 2.9 and 17.2 +- 3.3: Tops 2008), 136 degrees apart, in the direction of Dodge's mean vector
/// between them, which is shortened to what the sinus allows.
struct Root {
  Eigen::Vector3d p_annulus, p_left_ostium, p_right_ostium;  ///< patient frame, metres
  Eigen::Vector3d p_middle;                                 ///< of the sinuses, on the axis at the left ostium's height
  Eigen::Vector3d axis, to_left, to_right, to_noncoronary;  ///< unit vectors
  Eigen::Matrix3d heart;                                    ///< turns and scales the mean heart into this one

  /// From the mean heart's coordinates in mm relative to the left (right) ostium to the patient frame.
  Eigen::Vector3d from_left(const Eigen::Vector3d& p_mm) const { return p_left_ostium + heart * p_mm * 1e-3; }
  Eigen::Vector3d from_right(const Eigen::Vector3d& p_mm) const { return p_right_ostium + heart * p_mm * 1e-3; }
};

Root make_root(const AnatomyParameters& parameters);

}  // namespace ostium::vascular
