#pragma once
/// Courses of the coronary arteries for the chest phantom.
#include <string>

#include "fluoro/phantom/shapes.h"

namespace ostium::phantom {

struct Course {
  std::string name;
  bool left = true;
  Eigen::Matrix3Xd line;     ///< frame P, from the ostium or the parent
  Eigen::VectorXd radius_m;  ///< at each point
};

/// All of them, the main stems first: LAD with the left main, LCx, RCA, then branches.
/// `stenosis` by diameter narrows the LAD and the RCA over some 12 mm.
std::vector<Course> coronaries(double stenosis);
Eigen::Vector3d left_ostium();
Eigen::Vector3d right_ostium();
/// Points on the heart's surface that its shape is drawn round.
std::vector<Eigen::Vector3d> epicardial_points();

}  // namespace ostium::phantom
