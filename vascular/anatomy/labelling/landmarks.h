#pragma once
/// Landmarks of a labelled anatomy: transformed from the mean anatomy, then adjusted to its own vessels.
#include <map>
#include <optional>
#include <string>

#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/labelling/fit.h"

namespace ostium::vascular {

struct LandmarkInputs {
  const Landmarks& mean;
  Similarity fit;                                       ///< from the mean anatomy to this one's frame
  const std::map<std::string, Eigen::Vector3d>& ostia;  ///< of "LM" and "RCA", if found
  std::optional<Eigen::Vector3d> entry;                 ///< wanted position of the introducer, same frame
};

void set_landmarks(const LandmarkInputs& inputs, Anatomy& anatomy, std::vector<std::string>& notes);

/// Instruments enter at the point of a centreline that is nearest to `entry`; none: at the end of the aorta, or the
/// beginning of the first tube. An entry far outside adds a note.
void set_access(const std::optional<Eigen::Vector3d>& entry, Anatomy& anatomy, std::vector<std::string>& notes);

}  // namespace ostium::vascular
