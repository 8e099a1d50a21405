#pragma once
/// The lumen from the access to the coronary tips, as tubes, built from published numbers.
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "vascular/anatomy/parameters.h"
#include "vascular/geometry/implicit/tube.h"

namespace ostium::vascular {

/// A named stretch of a tube: the left main and the LAD share one tube.
struct NamedBranch {
  std::string name;
  int tube = 0;
  double from_m = 0, to_m = 0;  ///< arc lengths along the tube; a branch starts at its parent's wall
  double length_m() const { return to_m - from_m; }
};

/// The access, and landmarks of the heart.
struct Landmarks {
  Eigen::Vector3d p_access = Eigen::Vector3d::Zero();          ///< on the centreline, inside the lumen
  Eigen::Vector3d access_direction = Eigen::Vector3d::Zero();  ///< unit, direction in which an instrument enters
  Eigen::Vector3d p_left_ostium = Eigen::Vector3d::Zero(), p_right_ostium = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_annulus = Eigen::Vector3d::Zero();  ///< centre of the aortic annulus
  Eigen::Vector3d root_axis = Eigen::Vector3d::Zero();  ///< unit, from the annulus to the ascending aorta
  Eigen::Vector3d p_lv_base = Eigen::Vector3d::Zero();  ///< where the LV axis crosses the plane of the AV groove
  Eigen::Vector3d p_lv_apex = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_groove =
      Eigen::Vector3d::Zero();  ///< unit, perpendicular to that axis, towards the middle of the right groove
};

struct Anatomy {
  std::vector<Tube> tubes;  ///< parents before children; the first is the aorta
  bool aorta = true;        ///< false: a mesh of coronary arteries alone, where each tree has its own root
  /// The first tube moves with the aortic root for 20 mm, then decreasingly, and not at all from this arc length on.
  double ascending_m = 75e-3;
  std::vector<NamedBranch> branches;
  Landmarks landmarks;
};

/// Courses wander less where arteries would otherwise touch. Throws std::invalid_argument if a parameter is out of
/// range.
Anatomy build_anatomy(const AnatomyParameters& parameters);

/// Null if there is no branch of that name.
const NamedBranch* find_branch(const Anatomy& anatomy, const std::string& name);

}  // namespace ostium::vascular
