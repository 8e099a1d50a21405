#pragma once
/// One set with an undeclared effect, explained and the verdict checked.
#include <string>
#include <vector>

namespace ostium::synthetic {

struct Judged {
  std::string kind;
  unsigned seed = 0;
  std::string said;  ///< "rest_curvature", "explained", "unexplained (lab)", "ambiguous: a or b"
  bool right = false;
  double size = 0;   ///< residual of the declared fit beyond noise, relative to the noise of a distance
  double after = 0;  ///< held-out error afterwards, relative to the noise floor
  double chi2_before = 0, chi2_after = 0;
  int parameters = 0, within = 0;  ///< true parameters of the effect; those within three standard errors
  /// Of a learned law: points that the data reach, those of them whose band holds the truth, points in all, and half
  /// the band against the law where the data reach, in the median and at the 90th percentile.
  int law_reached = 0, law_within = 0, law_points = 0;
  double law_half_width = 0, law_widest = 0;
  double cpu_s = 0;
};

/// Throws std::runtime_error if no set can be made from this seed.
/// `only`: effects that are tried, together; empty: all that there are.
Judged judge(const std::string& kind, unsigned seed, int threads, const std::vector<std::string>& only = {});

}  // namespace ostium::synthetic
