#pragma once
/// Finds the aorta: the path through a lumen that is most like the mean aorta.
#include <optional>

#include "vascular/anatomy/labelling/fit.h"
#include "vascular/anatomy/lumen/lumen_parts.h"
#include "vascular/anatomy/lumen/mean_courses.h"

namespace ostium::vascular {

struct AortaMatch {
  Course course;
  Similarity fit;     ///< from the mean anatomy to the file's frame
  double doubt = 0;   ///< of its course: recognition.h
  bool arch = false;  ///< as many branches as recognition asks for leave it where and whither those of an arch do
};

inline constexpr double labelling_step_m = 5e-3;  ///< between the points of two courses that are compared

/// None if `widest` is too narrow for an aorta, or in no size like one. Otherwise gives `widest` the tree from the
/// aortic root. It is recognised if there is no doubt of its course, and its arch has branches or arteries are
/// recognised that leave it.
std::optional<AortaMatch> match_aorta(LumenPart& widest, const MeanCourses& mean, const Progress& say);

}  // namespace ostium::vascular
