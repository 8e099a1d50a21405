#include "data/identification/selection/degrees.h"

#include <algorithm>
#include <cmath>

namespace ostium::data {

std::optional<double> share_removed(const Misfit& before, const Misfit& after) {
  if (before.beyond_noise() <= 0) return {};
  // Noise is what is left at best: falling below it removes no more.
  return std::clamp(1 - std::max(after.beyond_noise(), 0.0) / before.beyond_noise(), 0.0, 1.0);
}

double rms_over_noise(const Misfit& m) { return std::sqrt(m.chi2 / std::max(m.degrees_of_freedom, 1.0)); }

bool removes_most(const Misfit& before, const Misfit& after) {
  const auto share = share_removed(before, after);
  return share && *share >= most_of_it;
}

}  // namespace ostium::data
