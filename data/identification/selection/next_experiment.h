#pragma once
/// What to measure next: the setting at which two explanations of a set predict the most different shapes.
#include "data/identification/estimation/fitted_model.h"
#include "data/identification/estimation/workers.h"

namespace ostium::data {

struct NextExperiment {
  std::string why;
  std::vector<Placement> set;
  double difference_m = 0;  ///< between what two explanations predict
};

/// None if no setting tells them apart by more than the noise (or 0.1 mm where it is unknown).
std::optional<NextExperiment> next_experiment(const MeasurementSet& set, const Workers& workers, const FittedModel& a,
                                              const FittedModel& b, const Noise& noise);

}  // namespace ostium::data
