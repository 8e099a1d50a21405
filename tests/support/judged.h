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
  double cpu_s = 0;
};

/// Throws std::runtime_error if no set can be made from this seed.
Judged judge(const std::string& kind, unsigned seed, int threads);

}  // namespace ostium::synthetic
