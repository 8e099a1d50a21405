#pragma once
/// Push measured at the base during insertion, which determines friction far better than shapes do.
#include "data/identification/forward/shape.h"

namespace ostium::data {

/// Assumed uncertainty of measured pushes, N: a tenth of their root mean square, as files do not give one. None without
/// pushes, or without a vessel: a push comes only from an insertion history.
std::optional<double> push_sigma_N(const MeasurementSet& set);

/// Measured minus model, N; none if it was not measured.
std::optional<double> push_misfit_N(const Experiment& experiment, const PredictedShape& shape);

/// Root mean square over the measured pushes, N; none if there are none.
std::optional<double> push_rms_N(const MeasurementSet& set, const std::vector<PredictedShape>& shapes);

}  // namespace ostium::data
