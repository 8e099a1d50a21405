#pragma once
/// Where coronary arteries may leave the aorta, and the ways on from there.
#include "vascular/anatomy/labelling/aorta_match.h"

namespace ostium::vascular {

/// The coronary arteries that come out of one ostium.
struct Trunk {
  std::size_t part;
  Eigen::Vector3d root;  ///< where the part's tree begins then
  std::vector<Eigen::Vector3d> ends;
  std::vector<Course> courses;  ///< to these, from the ostium on
};

/// `aorta`: that of the first part, or null.
std::vector<Trunk> coronary_trunks(const std::vector<LumenPart>& parts, const AortaMatch* aorta);

}  // namespace ostium::vascular
