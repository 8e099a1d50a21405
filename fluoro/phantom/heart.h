#pragma once
#include <Eigen/Core>

namespace ostium::fluoro::phantom {

/// The heart's surface in frame P, star-shaped about its middle: a hull of the epicardial points of the coronary
/// arteries and a few of the right heart, smoothed.
Eigen::Vector3d heart_middle();
double heart_radius(const Eigen::Vector3d& direction);  ///< along a unit vector

}  // namespace ostium::fluoro::phantom
