#pragma once
/// When one model counts as better than another, and when a model counts as complete.
#include "data/identification/estimation/fitted_model.h"

namespace ostium::data {

/// A difference in BIC that is strong evidence, and one that is positive evidence (Kass, Raftery 1995, J Am Stat Assoc
/// 90:773).
inline constexpr double strong_evidence = 6, positive_evidence = 2;

/// Whether one model's held-out error is below another's by 5 %: that of shapes, or, if these are predicted about as
/// well, that of pushes.
bool predicts_better(const FittedModel& a, const FittedModel& b);

/// An effect counts if it predicts what it has not seen better, and pays for its numbers.
bool wins(const FittedModel& candidate, const FittedModel& declared, const Noise& noise);

/// Whether what a model leaves is noise: chi2, correlation along the wire, dependence on what was varied.
bool is_noise(const FittedModel& model, const Noise& noise);

/// Whether a number of the model stands at the edge of its range: then it stands in for something else.
bool at_an_edge(const FittedModel& model);

}  // namespace ostium::data
