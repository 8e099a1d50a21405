#pragma once
/// The next experiment to make: the setting at which two explanations of a set predict the most different shapes.
#include "data/identification/estimation/fitted_model.h"
#include "data/identification/parallel/workers.h"

namespace ostium::data {

struct NextExperiment {
  std::string why;
  std::vector<Placement> set;
  double difference_m = 0;  ///< between the two explanations' predictions; MisfitUnit
};

/// None if no setting separates them by more than the noise (or 0.1 mm or px if that is unknown).
std::optional<NextExperiment> next_experiment(const MeasurementSet& set, const Workers& workers, const FittedModel& a,
                                              const FittedModel& b, const Noise& noise);

}  // namespace ostium::data
