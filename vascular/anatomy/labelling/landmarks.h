#pragma once
/// Landmarks of a labelled anatomy: laid on from the mean one, put where its own vessels say.
#include <map>
#include <optional>
#include <string>

#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/labelling/fit.h"

namespace ostium::vascular {

struct LandmarkInputs {
  const Landmarks& mean;
  Similarity fit;                                       ///< from the mean anatomy to this one's frame
  const std::map<std::string, Eigen::Vector3d>& ostia;  ///< of "LM" and "RCA", those recognised
  std::optional<Eigen::Vector3d> entry;                 ///< the introducer's place that was asked for, same frame
};

void set_landmarks(const LandmarkInputs& inputs, Anatomy& anatomy, std::vector<std::string>& notes);

}  // namespace ostium::vascular
