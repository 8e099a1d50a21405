#pragma once
/// Narrowings already present in a given lumen.
#include <string>
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"

namespace ostium::vascular {

struct FoundNarrowing {
  std::string branch;
  double at_m = 0;              ///< from the branch's first sphere to its narrowest
  double from_m = 0, to_m = 0;  ///< where it is narrow, by `least` or half of its depth, from there
  double stenosis = 0;          ///< of the diameter
  double reference_m = 0;       ///< diameter around it
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
};

/// In branches narrower than 8 mm: where the diameter is smaller, by the fraction `least` or more, than on both sides;
/// next to a bulge, than on the side without; where both sides are narrow, too, than the branch as a line, if it is as
/// wide as that further on. Not within 8 mm of a branch's end, which tapers.
std::vector<FoundNarrowing> find_narrowings(const SphereTree& tree, double least = 0.3);

/// Diameter of the narrowest, m; 0: there is none.
double narrowest_m(const std::vector<FoundNarrowing>& narrowings);

}  // namespace ostium::vascular
