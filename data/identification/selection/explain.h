#pragma once
/// Fits a set's declared model and the effects to be tried, and explains what is left.
#include <functional>

#include "data/identification/selection/explanation.h"

namespace ostium::data {

struct ExplainOptions {
  /// Candidates: each a list of effects to switch on together, by ids such as "shaft_torsion" or "shaft_torsion[1]".
  std::vector<std::vector<std::string>> tries;
  int threads = 0;  ///< 0: one per core
  std::function<void(const std::string&)> progress;
  /// If the declared model does not fit: search all effects and their combinations instead.
  bool library = false;
  /// Asked before each shape or history, from any thread: true ends the search with what it has found, once what is
  /// declared is fitted; empty: never. Not under MPI, whose ranks would part.
  std::function<bool()> stop = {};
};

/// Throws LoadError for a set that cannot be explained (in a vessel), an unknown effect, or one that cannot show.
Explanation explain(const MeasurementSet& set, const ExplainOptions& options);

}  // namespace ostium::data
