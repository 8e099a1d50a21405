#pragma once
/// Courses of the coronary arteries for the chest phantom.
#include "fluoro/phantom/branching.h"

namespace ostium::fluoro::phantom {

/// A main stem begins in the aorta, this many points upstream of its ostium.
inline constexpr Eigen::Index mouth_points = 15;

/// All courses, the main stems first: LAD with the left main, LCx, RCA, then branches, each after its parent. Stems and
/// named branches pass through published points; twigs are generated from a seed on the heart's surface. `stenosis` by
/// diameter narrows the LAD and the RCA over about 12 mm.
std::vector<Course> coronaries(double stenosis);
Eigen::Vector3d left_ostium();
Eigen::Vector3d right_ostium();
/// Points of the heart's surface, from which its shape is built.
std::vector<Eigen::Vector3d> epicardial_points();

}  // namespace ostium::fluoro::phantom
