#pragma once
/// Fits a model to the experiments of a set: weighted least squares with priors.
#include "data/identification/estimation/forward_model.h"
#include "data/identification/estimation/parameters.h"
#include "data/identification/residuals/noise_model.h"

namespace ostium::data {

struct Fit {
  bool converged = false;
  Eigen::VectorXd x;             ///< of the parameters, in the optimiser's numbers
  Eigen::MatrixXd covariance;    ///< of x, for the sigma used in the fit
  double sigma_m = 0;            ///< noise used to weight the data
  double chi2 = 0;               ///< of the fitted data
  double measured = 0;           ///< number of independent values fitted
  double parameters_used = 0;    ///< effective number of parameters determined by the data rather than the priors
  double informed(int i) const;  ///< 1: parameter i is determined by the data alone, 0: by its prior
  Eigen::VectorXd prior_sigma;
  std::vector<Eigen::VectorXd> misfits;  ///< of the fitted experiments

  double degrees_of_freedom() const { return std::max(measured - parameters_used, 1.0); }
};

struct FitOptions {
  std::vector<int> experiments;         ///< which to fit
  std::optional<double> sigma_m;        ///< of the noise; none: estimated from the residuals
  std::vector<Eigen::VectorXd> starts;  ///< where to begin
  std::size_t descents = 1;             ///< how many of the best starts to descend from; the best result counts
  /// A second group of starts from elsewhere. The best few of each group descend for some steps before they are
  /// compared, so that starts near a poor local minimum do not crowd out the others.
  std::vector<Eigen::VectorXd> other_starts = {};
  double guess_m = 1e-3;  ///< initial guess of an unknown noise
  int rounds = 4;         ///< of estimating the noise
  bool only_x = false;    ///< skip covariance and misfits
  /// Generalised least squares, robust if the tails are heavy: of centrelines; then sigma_m is its sigma.
  std::optional<NoiseModel> noise = {};
  bool rough = false;  ///< accurate enough to compare models, at a fraction of the time
};

/// Throws std::runtime_error if the model has no shapes at any start.
Fit fit(const ForwardModel& forward, const Parameters& parameters, const FitOptions& options);

/// Lower estimate of a fit's cost (half the sum of squares, with noise sigma_m or else guess_m) from a linear model
/// about each start: a preview for the price of one step. Infinite if there are no shapes at any start.
double cost_ahead(const ForwardModel& forward, const Parameters& parameters, const FitOptions& options);

/// Misfits of `chosen` at x; empty if there is no shape.
std::vector<Eigen::VectorXd> misfits(const ForwardModel& forward, const Parameters& parameters,
                                     const Eigen::VectorXd& x, const std::vector<int>& chosen);

}  // namespace ostium::data
