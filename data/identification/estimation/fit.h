#pragma once
/// Fits a model to the experiments of a set: weighted least squares with priors.
#include "data/identification/estimation/forward_model.h"
#include "data/identification/estimation/parameters.h"

namespace ostium::data {

struct Fit {
  bool converged = false;
  Eigen::VectorXd x;             ///< of the parameters
  Eigen::MatrixXd covariance;    ///< of x, for the sigma that it was fitted with
  double sigma_m = 0;            ///< noise that the data were weighted with
  double chi2 = 0;               ///< of the data fitted
  double measured = 0;           ///< independent numbers fitted
  double parameters_used = 0;    ///< as many of the parameters as the data decide, not the priors
  double informed(int i) const;  ///< 1: the data alone decide parameter i, 0: its prior
  Eigen::VectorXd prior_sigma;
  std::vector<Eigen::VectorXd> misfits;  ///< of the experiments fitted

  double degrees_of_freedom() const { return std::max(measured - parameters_used, 1.0); }
};

struct FitOptions {
  std::vector<int> experiments;         ///< which to fit
  std::optional<double> sigma_m;        ///< of the noise; none: taken from what the fit leaves
  std::vector<Eigen::VectorXd> starts;  ///< where to begin
  std::size_t descents = 1;             ///< from so many of the starts, those that cost least; the best end counts
  /// Other places to begin at, from somewhere else. Of each sort the foremost go a few steps downhill before they are
  /// compared, so that starts near a valley that leads nowhere do not crowd out the others.
  std::vector<Eigen::VectorXd> other_starts = {};
  double guess_m = 1e-3;  ///< of an unknown noise
  int rounds = 4;         ///< of finding it
  bool only_x = false;    ///< nothing else is asked for
  bool rough = false;     ///< enough to compare models by, in a fraction of the time
};

/// Throws std::runtime_error if the model has no shapes at any start.
Fit fit(const ForwardModel& forward, const Parameters& parameters, const FitOptions& options);

/// The least that a fit could cost (half the sum of squares, noise sigma_m or else guess_m) if the model were linear
/// about any of the starts: a look ahead for the price of one step. Infinite if there are no shapes at any.
double cost_ahead(const ForwardModel& forward, const Parameters& parameters, const FitOptions& options);

/// Misfits of `chosen` at x; empty where there is no shape.
std::vector<Eigen::VectorXd> misfits(const ForwardModel& forward, const Parameters& parameters,
                                     const Eigen::VectorXd& x, const std::vector<int>& chosen);

}  // namespace ostium::data
