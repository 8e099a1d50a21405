#pragma once
/// Which instruments may run inside which.
#include <vector>

#include "core/model/rod.h"

namespace ostium::core {

/// Largest number of outer rods around one rod.
inline constexpr int max_outer_rods = 3;

/// Rod `inner` runs inside the lumen of rod `outer` as far as both are in the body, and exits at the outer's tip.
///
/// Both are fed at the same introducer. With three or four coaxial instruments, each pair has its own nesting; where an
/// inner instrument could be in several lumens, it is in that of the last rod.
struct Nesting {
  int outer = 0, inner = 1;  ///< of Model::rods; outer < inner
  /// Length of lumen, back from the outer's tip, that holds the inner instrument, m. A rapid-exchange shaft: 0.25.
  /// Behind it, the inner one runs outside and is not held.
  double lumen_m = 1e3;
  double friction = 0;  ///< coefficient between the two, static and kinetic
};

/// Nestings of coaxial instruments, rods[0] the outermost: one for each pair.
std::vector<Nesting> coaxial(const std::vector<int>& rods);

/// Whether rod `inner` may run in rod `outer`.
bool is_nested(const std::vector<Nesting>& nestings, int outer, int inner);

/// Smallest clearance of rod `inner` in the lumen of `outer`, m; negative if it does not fit or there is no lumen.
double tightest_clearance_m(const Rod& outer, const Rod& inner, double lumen_m);

}  // namespace ostium::core
