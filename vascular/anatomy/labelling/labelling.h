#pragma once
/// A closed lumen of anyone becomes an anatomy: a tree of tubes, turned and moved into the patient frame, with the
/// names and the landmarks that the heart's motion is laid on by. What is known of people is our own mean anatomy:
/// aorta and coronary arteries are recognised by the rotation, shift and scale that bring its courses nearest to
/// theirs.
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "vascular/anatomy/anatomy.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct LabellingOptions {
  std::optional<Eigen::Matrix3d>
      axes;  ///< from the file's axes to the patient's; none: found by the aorta or the heart
  std::optional<Eigen::Vector3d> entry;  ///< the introducer is at the centreline's point nearest to this; file's frame
  std::map<std::string, std::string> names;  ///< found name to wanted name
  std::function<void(const std::string&)> progress;
};

struct LabelledVessels {
  Anatomy anatomy;                                     ///< patient frame
  Mesh lumen;                                          ///< the same surface, in the patient frame
  Eigen::Matrix3d R_PF = Eigen::Matrix3d::Identity();  ///< p_P = R_PF p_F - shift
  Eigen::Vector3d shift_P = Eigen::Vector3d::Zero();
  bool heart = false;                       ///< coronary arteries were found: they beat
  double aorta_rms_m = 0, heart_rms_m = 0;  ///< distance of our mean courses from theirs; 0: not compared
  std::vector<std::string> notes;           ///< what was taken for what, and what is uncertain
};

/// `lumen`: closed, in the file's axes. Throws MeshError if it holds no vessel (the longest way through it is less than
/// six times its width), or a name to be changed is not there.
LabelledVessels label_vessels(const Mesh& lumen, const LabellingOptions& options = {});

}  // namespace ostium::vascular
