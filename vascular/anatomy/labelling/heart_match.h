#pragma once
/// Which ways are the coronary arteries: the rotation, shift and scale that bring the mean ones nearest to them.
#include <map>

#include "vascular/anatomy/labelling/aorta_match.h"

namespace ostium::vascular {

struct HeartMatch {
  Similarity fit;                                ///< from the mean anatomy to the file's frame
  std::map<std::string, Eigen::Vector3d> ostia;  ///< of "LM" and "RCA", those recognised
};

/// None if nothing is like coronary arteries. Those recognised get their roles in `parts`; `aorta`: that of the first
/// part, or null.
std::optional<HeartMatch> match_heart(std::vector<LumenPart>& parts, const AortaMatch* aorta, const MeanCourses& mean,
                                      std::vector<std::string>& notes);

}  // namespace ostium::vascular
