#pragma once
/// What was measured at the base of an insertion: the push, which shows friction far better than shapes do.
#include "data/identification/forward/shape.h"

namespace ostium::data {

/// What measured pushes are taken to be known to, N: a tenth of their root mean square, as no file says. None without
/// pushes, or without a vessel: only the history of an insertion makes one.
std::optional<double> push_sigma_N(const MeasurementSet& set);

/// Measured minus model, N; none where it was not measured.
std::optional<double> push_misfit_N(const Experiment& experiment, const PredictedShape& shape);

/// Root mean square over those that were measured, N; none without any.
std::optional<double> push_rms_N(const MeasurementSet& set, const std::vector<PredictedShape>& shapes);

}  // namespace ostium::data
