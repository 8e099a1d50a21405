#pragma once
/// From where on a vessel is taken for an aorta, or vessels for coronary arteries.
///
/// The limits are estimates; tests/RESULTS.md has what made-up people and made-up vessels of other organs are taken
/// for. One artery alone is never recognised: turned and scaled, a mean course comes as near to any bend. Nor is an
/// aorta without any of its branches: a wide tube may be bent like an arch.
#include "vascular/anatomy/labelling/fit.h"

namespace ostium::vascular {

inline constexpr int least_arch_branches = 2;  ///< a common trunk for two of the three is frequent

/// What a fit of the mean coronary arteries rests on.
struct HeartEvidence {
  bool left = false, circumflex = false, right = false;
  bool aorta = false;  ///< they leave an aorta that has its arch's branches
};

/// How unlike the mean anatomy, over what is allowed; below 1 it is recognised.
double aorta_doubt(const Similarity& fit, double length_m);
double heart_doubt(const Similarity& fit, const HeartEvidence& evidence);

}  // namespace ostium::vascular
