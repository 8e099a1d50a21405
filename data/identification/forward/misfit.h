#pragma once
/// How a model's shape appears in the measurement, and the misfit to it.
#include <Eigen/Geometry>

#include "data/identification/forward/shape.h"

namespace ostium::data {

/// The view of an experiment, including effects on the imaging. `view` has no cameras yet.
MeasuredView seen(const MeasurementSet& set, const Experiment& experiment, const Changes& changes, MeasuredView view);

/// Measured minus model in the measurement frame, m. Centreline: offset of each point from the nearest point of the
/// model's (3 numbers, perpendicular to it); tip: its offset (3); radius: the difference (1);
/// polylines: see projected.h.
Eigen::VectorXd misfit(const Experiment& experiment, const PredictedShape& shape, const MeasuredView& view);

/// The tracked tip in the measurement frame.
Eigen::Vector3d tracked_tip(const PredictedShape& shape, const MeasuredView& view);

/// Number of distances that enter an RMS: points of a centreline or of polylines, else 1.
std::size_t distances(const Experiment& experiment);
/// Number of independent values: 2 per point of a centreline, 1 per point of a polyline, 3 for a tip, 1 for a radius.
std::size_t numbers_measured(const Experiment& experiment);
/// Length of the vector that `misfit` returns.
std::size_t misfit_rows(const Experiment& experiment);

/// The root mean square distance that noise alone leaves: sqrt(2) sigma for centrelines, sigma for polylines.
double noise_floor(const MeasurementSet& set, double sigma_m);

/// Root mean square distance over these experiments, m; `misfits` in the same order.
double rms(const std::vector<const Experiment*>& experiments, const std::vector<Eigen::VectorXd>& misfits);
/// The same over all experiments of the set.
double rms(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

}  // namespace ostium::data
