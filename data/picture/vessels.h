#pragma once
/// Vessels in an angiogram, found and measured: ridges of the logarithm, their skeleton, profiles across it.
#include <optional>

#include "data/picture/skeleton.h"

namespace ostium::data {

/// Across a vessel.
struct Profile {
  double width_px = 0;            ///< full width at half depth
  double depth = 0;               ///< grey levels below what lies on either side
  double background = 0;          ///< there, at its middle
  int branch = 0;                 ///< of the skeleton
  std::optional<double> blur_px;  ///< standard deviation of a cylinder's shadow fitted to it, if one fits
};

struct VesselTree {
  Mask mask;  ///< vessels with a margin
  double length_px = 0;
  int junctions = 0;
  double bend_rad_px = 0;  ///< turning per length of long branches; 0: there are none
  std::vector<Profile> profiles;
};

/// `inner`: where to look.
VesselTree find_vessels(const Image& image, const Mask& inner);

}  // namespace ostium::data
