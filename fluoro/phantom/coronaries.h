#pragma once
/// Courses of the coronary arteries for the chest phantom.
#include "fluoro/phantom/branching.h"

namespace ostium::fluoro::phantom {

/// A main stem begins in the aorta, upstream of its ostium by so many points of its line.
inline constexpr Eigen::Index mouth_points = 15;

/// All of them, the main stems first: LAD with the left main, LCx, RCA, then branches, each after what it leaves.
/// Stems and named branches run through published points, twigs grow from a seed on the heart's surface.
/// `stenosis` by diameter narrows the LAD and the RCA over some 12 mm.
std::vector<Course> coronaries(double stenosis);
Eigen::Vector3d left_ostium();
Eigen::Vector3d right_ostium();
/// Points on the heart's surface that its shape is drawn round.
std::vector<Eigen::Vector3d> epicardial_points();

}  // namespace ostium::fluoro::phantom
