#pragma once
/// How a model's shape appears in a measurement, and how far off it is.
#include <Eigen/Geometry>

#include "data/identification/forward/shape.h"

namespace ostium::data {

/// How an experiment is seen where effects change the picture.
MeasuredView seen(const MeasurementSet& set, const Experiment& experiment, const Changes& changes, MeasuredView view);

/// Measured minus model, in the frame of the measurement, m: for each point of a centreline the offset from the
/// nearest point of the model's (3 numbers, across it), for a tip its offset (3), for a radius the difference (1).
Eigen::VectorXd misfit(const Experiment& experiment, const PredictedShape& shape, const MeasuredView& view);

/// The tracked tip in the frame of the measurement.
Eigen::Vector3d tracked_tip(const PredictedShape& shape, const MeasuredView& view);

/// Distances that count into an RMS: points of a centreline, or 1.
std::size_t distances(const Experiment& experiment);
/// Independent numbers: 2 for each point of a centreline, 3 for a tip, 1 for a radius.
std::size_t numbers_measured(const Experiment& experiment);

/// Root mean square distance over these experiments, m; `misfits` belong to them.
double rms(const std::vector<const Experiment*>& experiments, const std::vector<Eigen::VectorXd>& misfits);
/// ... over all experiments of the set.
double rms(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

}  // namespace ostium::data
