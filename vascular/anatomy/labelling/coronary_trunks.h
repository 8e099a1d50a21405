#pragma once
/// Candidate ostia of coronary arteries, and the courses from there.
#include "vascular/anatomy/labelling/aorta_match.h"

namespace ostium::vascular {

/// All candidate courses from one ostium.
struct Trunk {
  std::size_t part;
  Eigen::Vector3d root;  ///< where the part's tree would begin
  std::vector<Eigen::Vector3d> ends;
  std::vector<Course> courses;  ///< from the ostium to these ends
};

/// `aorta`: match of the first part, or null.
std::vector<Trunk> coronary_trunks(const std::vector<LumenPart>& parts, const AortaMatch* aorta);

}  // namespace ostium::vascular
