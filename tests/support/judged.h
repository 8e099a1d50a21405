#pragma once
/// One set with an undeclared effect, explained and judged.
#include <string>
#include <vector>

namespace ostium::synthetic {

struct Judged {
  std::string kind;
  unsigned seed = 0;
  std::string said;  ///< "rest_curvature", "explained", "unexplained (lab)", "ambiguous: a or b"
  bool right = false;
  double size = 0;   ///< what the declared fit leaves beyond noise, over the noise of a distance
  double after = 0;  ///< held-out error after, over the floor of the noise
  double chi2_before = 0, chi2_after = 0;
  int parameters = 0, within = 0;  ///< true numbers of the effect, and those within three standard errors
  double cpu_s = 0;
};

/// Throws std::runtime_error if this seed makes no set.
Judged judge(const std::string& kind, unsigned seed, int threads);

}  // namespace ostium::synthetic
