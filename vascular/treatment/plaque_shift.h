#pragma once
/// Plaque that is pushed along the wall into the mouth of a side branch.
///
/// Of the plaque up to 3 mm ahead of a fork a share goes into the side branch's mouth as balloon or stent take its
/// place,
///   V = alpha integral of min(1, (a^2 - d^2) / (h^2 - d^2)) pi (h^2 - d^2) ds
/// with a the lumen's largest radius so far, d and h those diseased and healthy. alpha is 0.08: ahead of a crossed
/// branch 8.4 are left of 9.1 mm3 of plaque a millimetre (intravascular ultrasound, Koo et al. 2010). It takes lumen
/// from the mouth, most at its edge, less and less along 3 mm; a balloon in the mouth presses it away, for good.
#include "vascular/treatment/carina.h"

namespace ostium::vascular {

/// V of a fork, m3.
double pushed_plaque_m3(const FlowTree& tree, const PlaqueModel& plaque, const PlaqueState& wall, const Fork& fork);
/// What stays of it in a mouth with a balloon of that radius; 0: there is none.
double plaque_left_m3(const FlowTree& tree, const Fork& fork, double plaque_m3, double balloon_m);
/// What is left of the radius of a mouth, [0, 1], at a share of the way along it.
double mouth_beside_plaque(double radius_m, double plaque_m3, double way);

inline constexpr double plaque_reach_m = 3e-3;  ///< ahead of the fork, and along the mouth

}  // namespace ostium::vascular
