#pragma once
/// Criteria for one model being better than another, and for a model being complete.
#include "data/identification/estimation/fitted_model.h"
#include "data/identification/selection/degrees.h"

namespace ostium::data {

/// BIC differences that are strong and positive evidence (Kass, Raftery 1995, J Am Stat Assoc 90:773).
inline constexpr double strong_evidence = 6, positive_evidence = 2;

/// Whether a's held-out error is below b's by 5 %: that of the shapes or, if these are about equal, that of the pushes.
bool predicts_better(const FittedModel& a, const FittedModel& b);

/// Whether the candidate predicts held-out data better and its BIC justifies its parameters.
bool wins(const FittedModel& candidate, const FittedModel& declared, const Noise& noise);

/// Whether a model's residual is noise, by chi2, correlation along the wire and dependence on the varied quantities.
bool is_noise(const FittedModel& model, const Noise& noise);

/// Whether the residual goes with something that was varied: a pattern, which noise of whatever kind has not. False
/// where it was not tested.
bool has_pattern(const FittedModel& model);

/// BIC with the noise that the model's own residual shows.
double own_noise_bic(const MeasurementSet& set, const FittedModel& model);

/// Whether one of its effects is a law learned from the data.
bool has_law(const FittedModel& model);

Misfit misfit_of(const FittedModel& model);

/// Whether a parameter is at the edge of its range: then it stands in for something else.
bool at_an_edge(const FittedModel& model);

}  // namespace ostium::data
