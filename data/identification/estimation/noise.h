#pragma once
/// How large the measuring noise is, and whether what a fit leaves looks like it.
#include <Eigen/Core>

#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

struct Noise {
  std::optional<double> sigma_m;  ///< per coordinate (of a radius: of the radius)
  bool declared = false;
  std::string from;  ///< in words: "declared", "point to point", "repeats", "unknown"
};

/// Declared, or what no smooth model could follow: for centrelines the part of five neighbours' misfits that a cubic
/// cannot (Gasser, Sroka, Jennen-Steinmetz 1986, Biometrika 73:625, with a higher order), for tips and radii the
/// scatter of experiments that were set up alike. `misfits` belong to the set's experiments.
Noise noise_of(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

/// Correlation of neighbours' misfits along the wire, and how many standard errors it is off zero; none without
/// centrelines.
struct Correlation {
  double value = 0, standard_errors = 0;
};
std::optional<Correlation> correlation_along(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits);

}  // namespace ostium::data
