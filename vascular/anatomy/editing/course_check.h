#pragma once
/// Whether an anatomy's courses lie in the lumen that they are of.
#include <vector>

#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/editing/lumen_gauge.h"

namespace ostium::vascular {

/// A stretch of a tube with one fault.
struct CourseFault {
  enum class Kind {
    outside,   ///< of the lumen
    too_wide,  ///< its spheres reach through the wall
    too_thin,  ///< larger spheres have room there: it is off the middle, or was made too narrow
    apart      ///< a branch that does not begin in its parent
  } kind = Kind::outside;
  int tube = 0;
  double from_m = 0, to_m = 0;  ///< along the tube
  double worst_m = 0;           ///< by how much, where it is worst; of `too_thin`, what the radius lacks
  double worst_at_m = 0;        ///< along the tube
};

/// A sphere may differ from the lumen by that share of its radius, and by 0.1 mm.
inline constexpr double course_tolerance = 0.2;

/// By tube and place. Where a tube lies in its parent, and within a radius of its ends, where lids and the parent's
/// wall are nearer than its own, only `outside` is looked for.
std::vector<CourseFault> check_courses(const Anatomy& anatomy, const LumenGauge& lumen);

}  // namespace ostium::vascular
