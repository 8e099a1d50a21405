#pragma once
/// Estimates the measurement noise, and tests whether a residual looks like it.
#include <Eigen/Core>

#include "data/identification/measurement/measurement_set.h"
#include "data/identification/residuals/noise_model.h"

namespace ostium::data {

struct Noise {
  std::optional<double> sigma_m;  ///< per coordinate; for radii, of the radius
  bool declared = false;
  std::string from;  ///< source: "declared", "point to point", "repeats", "residual", "unknown"
  /// Noise that is not as declared, or, where nothing was, not normal or not independent; then sigma_m is its sigma.
  std::optional<NoiseModel> model;
};

/// Whether a noise model can be told from a set: centrelines alone, at rest. Tips have no neighbours.
bool has_traces(const MeasurementSet& set);
/// The misfits of centrelines along the wire.
std::vector<ResidualTrace> traces_of(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);
/// Where the points of a centreline lie, m along it.
Eigen::VectorXd along(const Experiment& centreline);

/// The noise that this residual shows, if it is nothing else; nothing if it is as declared.
std::optional<NoiseModel> other_noise(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

/// Declared, or what no smooth model could follow: for centrelines, the part of five neighbouring misfits that a cubic
/// cannot follow (Gasser, Sroka, Jennen-Steinmetz 1986, Biometrika 73:625, with a higher order); for tips and radii,
/// the scatter of repeated experiments. `misfits` belong to the set's experiments.
Noise noise_of(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

/// Correlation of neighbouring misfits along the wire, and by how many standard errors it differs from zero; none
/// without centrelines.
struct Correlation {
  double value = 0, standard_errors = 0;
};
std::optional<Correlation> correlation_along(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

}  // namespace ostium::data
