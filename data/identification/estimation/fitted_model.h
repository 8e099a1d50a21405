#pragma once
/// The result of fitting one model.
#include "data/identification/estimation/learned_law.h"
#include "data/identification/estimation/parameters.h"
#include "data/identification/residuals/noise.h"
#include "data/identification/residuals/residual_tests.h"

namespace ostium::data {

struct FittedParameter {
  Parameter parameter;
  double value = 0, sigma = 0;
  double informed = 0;  ///< 1: determined by the data, 0: by the prior
};

/// One model: as declared, or with effects added.
struct FittedModel {
  std::string name;                  ///< "shaft_torsion + roll_loss[0]", or "what is declared"
  std::vector<std::string> effects;  ///< ids, without duplicates
  std::vector<FittedParameter> parameters;
  std::vector<LearnedLaw> laws;  ///< of the effects that are laws
  Changes changes;
  MeasuredView view;
  double rms_m = 0;
  std::optional<double> rms_held_out_m;
  std::optional<double> push_rms_N, push_rms_held_out_N;  ///< if pushes were measured in a vessel
  std::optional<double> chi2_per_dof;                     ///< none if the noise is unknown
  double degrees_of_freedom = 0, parameters_used = 0;
  double bic = 0;
  bool converged = false;
  std::vector<PredictedShape> shapes;    ///< one per experiment
  std::vector<Eigen::VectorXd> misfits;  ///< one per experiment
  std::vector<Eigen::VectorXd>
      held_out_misfits;  ///< the same, from the fits that left each experiment out; empty if there are none
  std::vector<double> experiment_rms_m;    ///< one per experiment
  std::optional<Correlation> correlation;  ///< along the wire
  ResidualTests residual_tests;
  /// Experiments for which stepping to the fitted values (walk) ends in another shape than the fitted one.
  std::vector<std::string> other_branches;
};

}  // namespace ostium::data
