#pragma once
/// What a fit of one model found.
#include "data/identification/estimation/noise.h"
#include "data/identification/estimation/parameters.h"
#include "data/identification/estimation/residual_tests.h"

namespace ostium::data {

struct FittedParameter {
  Parameter parameter;
  double value = 0, sigma = 0;
  double informed = 0;  ///< 1: found in the data, 0: the prior's
};

/// One model: what is declared, or that with effects.
struct FittedModel {
  std::string name;                  ///< "shaft_torsion + roll_loss[0]", or "what is declared"
  std::vector<std::string> effects;  ///< ids, each once
  std::vector<FittedParameter> parameters;
  Changes changes;
  MeasuredView view;
  double rms_m = 0;
  std::optional<double> rms_held_out_m;
  std::optional<double> push_rms_N, push_rms_held_out_N;  ///< where pushes were measured in a vessel
  std::optional<double> chi2_per_dof;                     ///< none if the noise is not known
  double degrees_of_freedom = 0;
  double bic = 0;
  bool converged = false;
  std::vector<PredictedShape> shapes;    ///< one per experiment
  std::vector<Eigen::VectorXd> misfits;  ///< one per experiment
  std::vector<Eigen::VectorXd>
      held_out_misfits;                    ///< the same by the fits that have not seen them; empty if there are none
  std::vector<double> experiment_rms_m;    ///< one per experiment
  std::optional<Correlation> correlation;  ///< along the wire
  ResidualTests residual_tests;
  /// Experiments whose shape, walked to with the fitted values, is another than the one that was fitted.
  std::vector<std::string> other_branches;
};

}  // namespace ostium::data
