#pragma once
/// Finds the coronary arteries: the courses that the mean ones fit best by rotation, shift and scale.
#include <map>

#include "vascular/anatomy/labelling/aorta_match.h"

namespace ostium::vascular {

struct HeartMatch {
  Similarity fit;                                ///< from the mean anatomy to the file's frame
  std::map<std::string, Eigen::Vector3d> ostia;  ///< of "LM" and "RCA", if found
  double doubt = 0;                              ///< recognition.h
};

/// None if nothing can be a coronary artery. Arteries that are recognised, or `assumed`, get their roles in `parts`;
/// `aorta`: match of the first part, or null.
std::optional<HeartMatch> match_heart(std::vector<LumenPart>& parts, const AortaMatch* aorta, const MeanCourses& mean,
                                      bool assumed, std::vector<std::string>& notes);

}  // namespace ostium::vascular
