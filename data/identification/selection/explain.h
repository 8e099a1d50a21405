#pragma once
/// Fits what a set declares and the effects that are to be tried, and says what is left.
#include <functional>

#include "data/identification/selection/explanation.h"

namespace ostium::data {

struct ExplainOptions {
  /// Candidates: each a list of effects to be switched on together, of ids such as "shaft_torsion" or
  /// "shaft_torsion[1]".
  std::vector<std::vector<std::string>> tries;
  int threads = 0;  ///< 0: one for each core
  std::function<void(const std::string&)> progress;
  /// Every effect that there is, and several together, instead: where the declared model does not fit.
  bool library = false;
};

/// Throws LoadError for a set that cannot be explained (in a vessel), an unknown effect, or one that cannot show.
Explanation explain(const MeasurementSet& set, const ExplainOptions& options);

}  // namespace ostium::data
