#include "vascular/anatomy/labelling/recognition.h"

#include <limits>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double impossible = std::numeric_limits<double>::infinity();
constexpr double shortest_aorta_m = 150 * mm;  // less has hardly more than one bend
// Rms distances at the mean's size.
constexpr double aorta_m = 12 * mm, all_three_m = 9 * mm, left_tree_m = 4.5 * mm, two_sides_m = 4.5 * mm;
constexpr double at_aorta_m = 12 * mm, one_at_aorta_m = 7 * mm;

}  // namespace

double aorta_doubt(const Similarity& fit, double length_m) {
  return length_m < shortest_aorta_m ? impossible : fit.rms_m / fit.scale / aorta_m;
}

double heart_doubt(const Similarity& fit, const HeartEvidence& e) {
  const int arteries = e.left + e.circumflex + e.right;
  double allowed = 0;
  if (e.aorta)
    allowed = arteries > 1 ? at_aorta_m : one_at_aorta_m;
  else if (arteries == 3)
    allowed = all_three_m;
  else if (arteries == 2)
    allowed = e.right ? two_sides_m : left_tree_m;
  return allowed > 0 ? fit.rms_m / fit.scale / allowed : impossible;
}

}  // namespace ostium::vascular
