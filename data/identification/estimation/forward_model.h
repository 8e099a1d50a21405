#pragma once
/// Computes the shapes that a fit needs.
#include <map>

#include "data/identification/forward/shape.h"
#include "data/identification/parallel/workers.h"

namespace ostium::data {

/// Shapes of a set's experiments for any parameters. Each starts from its anchor, so no result depends on earlier
/// calls.
class ForwardModel {
 public:
  ForwardModel(const MeasurementSet& set, const Workers& workers, std::vector<StaticEquilibrium> anchors)
      : set_(set), workers_(workers), anchors_(std::move(anchors)) {}

  const MeasurementSet& set() const { return set_; }
  void set_longest_element(double longest_m) { longest_element_m_ = longest_m; }
  /// shapes[v][k]: experiment chosen[k] under changes[v].
  std::vector<std::vector<PredictedShape>> shapes(const std::vector<Changes>& changes,
                                                  const std::vector<int>& chosen) const;

 private:
  std::vector<std::vector<PredictedShape>> histories(const std::vector<Changes>& changes,
                                                     const std::vector<int>& chosen) const;

  const MeasurementSet& set_;
  const Workers& workers_;
  std::vector<StaticEquilibrium> anchors_;
  double longest_element_m_ = fine_elements_m;
  /// Histories already run, by what was changed: folds ask for the same ones again. Written between jobs only.
  mutable std::map<std::vector<double>, std::vector<PredictedShape>> known_;
};

}  // namespace ostium::data
