#pragma once
/// The lumen from the access to the coronary tips, as tubes, built from published numbers.
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "vascular/anatomy/parameters.h"
#include "vascular/geometry/implicit/tube.h"

namespace ostium::vascular {

/// A stretch of a tube that has a name of its own: the left main and the LAD are one tube.
struct NamedBranch {
  std::string name;
  int tube = 0;
  double from_m = 0, to_m = 0;  ///< arc lengths along the tube; where a branch leaves, from its parent's wall
  double length_m() const { return to_m - from_m; }
};

/// Where an instrument comes in, and the heart's own landmarks.
struct Landmarks {
  Eigen::Vector3d p_access = Eigen::Vector3d::Zero();          ///< on the centreline, inside the lumen
  Eigen::Vector3d access_direction = Eigen::Vector3d::Zero();  ///< unit, the way an instrument goes in
  Eigen::Vector3d p_left_ostium = Eigen::Vector3d::Zero(), p_right_ostium = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_annulus = Eigen::Vector3d::Zero();  ///< middle of the aortic annulus
  Eigen::Vector3d root_axis = Eigen::Vector3d::Zero();  ///< unit, from the annulus to the ascending aorta
  Eigen::Vector3d p_lv_base = Eigen::Vector3d::Zero();  ///< the left ventricle's axis meets the plane of the AV groove
  Eigen::Vector3d p_lv_apex = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_groove =
      Eigen::Vector3d::Zero();  ///< unit, across that axis, to the middle of the right groove
};

struct Anatomy {
  std::vector<Tube> tubes;  ///< parents before children; the first is the aorta
  bool aorta = true;        ///< false: there is none (someone's coronary arteries alone), each tree has its own root
  /// The first tube moves as the root does up to 20 mm along it, and less and less from there to here.
  double ascending_m = 75e-3;
  std::vector<NamedBranch> branches;
  Landmarks landmarks;
};

/// Where arteries would touch that do not branch, the courses wander less. Throws std::invalid_argument if the
/// parameters are outside what they say.
Anatomy build_anatomy(const AnatomyParameters& parameters);

/// Null if there is none of that name.
const NamedBranch* find_branch(const Anatomy& anatomy, const std::string& name);

}  // namespace ostium::vascular
