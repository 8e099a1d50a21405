#include "data/identification/estimation/folds.h"

#include <algorithm>

namespace ostium::data {

std::vector<std::vector<int>> folds_of(const MeasurementSet& set) {
  // Units that stay together: a group, or an experiment without one.
  std::vector<std::vector<int>> blocks;
  std::vector<std::string> names;
  bool groups = false;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    const std::string& group = set.experiments[e].group;
    groups = groups || !group.empty();
    const auto known = std::find(names.begin(), names.end(), group);
    if (group.empty() || known == names.end()) {
      names.push_back(group);
      blocks.emplace_back();
      blocks.back().push_back(static_cast<int>(e));
    } else {
      blocks[known - names.begin()].push_back(static_cast<int>(e));
    }
  }
  const std::size_t n = blocks.size();
  if (n < 2) return {};
  const std::size_t count = groups && n < 8 ? n : std::min<std::size_t>(4, n);
  std::vector<std::vector<int>> folds(count);
  for (std::size_t b = 0; b < n; ++b) {
    auto& fold = folds[b * count / n];
    fold.insert(fold.end(), blocks[b].begin(), blocks[b].end());
  }
  return folds;
}

}  // namespace ostium::data
