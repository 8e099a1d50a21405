#pragma once
/// Turns any closed lumen into an anatomy: a tree of tubes in the patient frame, with names and the landmarks needed
/// for cardiac motion. The reference is our own mean anatomy: aorta and coronary arteries are found by the rotation,
/// shift and scale that best fit its courses to the given ones, and take their names where they do so better than they
/// fit vessels of other organs (recognition.h). Elsewhere vessels have numbers, nothing is turned, and nothing moves.
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "vascular/anatomy/anatomy.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Whether aorta and coronary arteries are looked for, and found where they are like ours, or coronary arteries
/// whatever is most like them, and an aorta without any branch of one.
enum class HeartSearch { none, recognised, assumed };

struct LabellingOptions {
  HeartSearch heart = HeartSearch::recognised;
  std::optional<Eigen::Matrix3d>
      axes;  ///< from the file's axes to the patient's; none: determined from the aorta or the heart
  std::optional<Eigen::Vector3d> entry;  ///< wanted position of the introducer (nearest centreline point), file frame
  std::map<std::string, std::string> names;  ///< found name to wanted name
  std::function<void(const std::string&)> progress;
};

struct LabelledVessels {
  Anatomy anatomy;                                     ///< patient frame
  Mesh lumen;                                          ///< the same surface, in the patient frame
  Eigen::Matrix3d R_PF = Eigen::Matrix3d::Identity();  ///< p_P = R_PF p_F - shift
  Eigen::Vector3d shift_P = Eigen::Vector3d::Zero();
  bool heart = false;                       ///< coronary arteries were found: they move with the heart
  double aorta_rms_m = 0, heart_rms_m = 0;  ///< rms distance from our mean courses; 0: none found
  /// How unlike the mean ones the likeliest vessels are, over what is allowed; from 1 on they are not recognised, and
  /// keep numbers. 0: none is a candidate.
  double aorta_doubt = 0, heart_doubt = 0;
  std::vector<std::string> notes;  ///< what was identified as what, and what is uncertain
};

/// `lumen`: closed, in the file's axes. Throws MeshError if it contains no vessel (its longest path is shorter than six
/// times its width), if a name to be changed does not exist, or if coronary arteries are assumed and no vessel can be
/// one, or an aorta.
LabelledVessels label_vessels(const Mesh& lumen, const LabellingOptions& options = {});

}  // namespace ostium::vascular
