#include "vascular/geometry/repair/facing_ends.h"

#include <algorithm>

namespace ostium::vascular {

namespace {

/// Gap between two openings if they are the ends of one cut vessel: similar and facing each other.
double gap_between(const Opening& a, const Opening& b, double longest_gap_m) {
  const Eigen::Vector3d gap = b.middle - a.middle;
  const double wide = (a.diameter_m + b.diameter_m) / 2, ratio = a.diameter_m / b.diameter_m;
  if (!a.end || !b.end || ratio > 1.5 || ratio < 1 / 1.5) return -1;
  if (gap.norm() > std::min(longest_gap_m, 3 * wide) || a.outwards.dot(b.outwards) > -0.6) return -1;
  const double across = (gap - gap.dot(a.outwards) * a.outwards).norm();
  if (across > 0.35 * wide + 0.3 * gap.norm() || gap.dot(a.outwards) < -0.3 * wide) return -1;
  return gap.norm();
}

}  // namespace

std::vector<FacingEnds> facing_ends(const std::vector<Opening>& openings, double longest_gap_m) {
  std::vector<FacingEnds> pairs;
  for (std::size_t i = 0; i < openings.size(); ++i)
    for (std::size_t j = i + 1; j < openings.size(); ++j)
      if (const double gap = gap_between(openings[i], openings[j], longest_gap_m); gap >= 0)
        pairs.push_back({gap, i, j});
  std::sort(pairs.begin(), pairs.end(), [](const FacingEnds& a, const FacingEnds& b) { return a.gap_m < b.gap_m; });
  return pairs;
}

}  // namespace ostium::vascular
