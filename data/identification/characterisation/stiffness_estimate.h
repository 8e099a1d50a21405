#pragma once
/// What one measured set says of the stiffness of its instrument.
#include <string>
#include <vector>

#include "data/formats/json/json_value.h"
#include "data/identification/curves/curve_explanation.h"
#include "data/identification/selection/explanation.h"

namespace ostium::data {

enum class Stiffness { bending, torsion };  ///< EI, GJ

/// One stiffness on one stretch, with the prior of the fit taken out again, so that several sets can be combined.
struct StiffnessEstimate {
  Stiffness of = Stiffness::bending;
  double from_tip_m = 0, to_tip_m = 0;
  double value_N_m2 = 0;
  double sigma = 0;  ///< standard error of its logarithm
};

/// The coefficient of friction between instrument and rig.
struct FrictionEstimate {
  double value = 0, sigma = 0;
};

/// A Gaussian posterior of the logarithm of a scale, without its Gaussian prior of mean 0 and deviation `spread`: mean
/// and deviation. A deviation of 0: the data say less than the prior.
struct LogScale {
  double mean = 0, sigma = 0;
};
LogScale without_prior(double scale, double sigma, double spread);

/// From the best model of a set of shapes of a single instrument: bending. Torsion goes with it there, and is none.
std::vector<StiffnessEstimate> estimates_of(const MeasurementSet& as_read, const Explanation& found);

/// From the best model of a set of curves; `root` is its file.
std::vector<StiffnessEstimate> estimates_of(const JsonValue& root, const curves::CurveExplanation& found);

/// Of a set of curves whose kind has friction that can be fitted: its best model, with friction free.
std::optional<FrictionEstimate> friction_of(const JsonValue& root, const curves::CurveExplanation& found);

}  // namespace ostium::data
