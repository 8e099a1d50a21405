#pragma once
/// Openings that face each other: the two ends of one vessel that was cut.
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

struct FacingEnds {
  double gap_m;
  std::size_t a, b;  ///< openings
};

/// Nearest pairs first; an opening may be in several pairs.
std::vector<FacingEnds> facing_ends(const std::vector<Opening>& openings, double longest_gap_m);

}  // namespace ostium::vascular
