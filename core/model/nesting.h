#pragma once
/// Which instruments may run inside which.
#include <vector>

#include "core/model/rod.h"

namespace ostium::core {

/// Most outer rods that one rod can run in at once.
inline constexpr int max_outer_rods = 3;

/// Rod `inner` runs inside the lumen of rod `outer` as far as both are in the body, and leaves it at the outer's tip.
///
/// Both are fed at the same introducer. Between three and four coaxial instruments, each pair has a nesting of its own:
/// where an inner instrument could be in several lumens, it is in that of the last rod.
struct Nesting {
  int outer = 0, inner = 1;  ///< of Model::rods; outer < inner
  /// How far back from the outer's tip its lumen holds the inner instrument, m. A rapid-exchange shaft: 0.25. Behind
  /// this the inner one runs outside, free of it.
  double lumen_m = 1e3;
  double friction = 0;  ///< coefficient between the two, static and kinetic
};

/// Nestings of coaxial instruments, rods[0] the outermost: one for each pair.
std::vector<Nesting> coaxial(const std::vector<int>& rods);

/// Room of rod `inner` in the lumen of `outer` where it is tightest, m: negative if it does not fit, or has no lumen.
double tightest_clearance_m(const Rod& outer, const Rod& inner, double lumen_m);

}  // namespace ostium::core
