#pragma once
/// How well a learned law is known, and what it looks like.
#include <functional>

#include "data/identification/effects/law_curve.h"

namespace ostium::data {

/// A law with its uncertainty at each point of its curve.
struct LearnedLaw {
  LawCurve curve;
  std::vector<double> sigma;      ///< standard deviation of y
  std::vector<double> from_data;  ///< share of the prior's variance of y that the data removed, 0 to 1
  std::string looks_like;         ///< a form of the library within the band, in words; "" if there is none

  /// Whether the data decide what the law is there; elsewhere it is its prior.
  bool reached(std::size_t i) const { return from_data[i] >= least_from_data; }
  static constexpr double least_from_data = 0.9;
};

/// Half the width of a band in standard deviations.
inline constexpr double band_sigmas = 2;

/// The law at x, which has this covariance and independent normal priors of these spreads: linear propagation.
LearnedLaw with_band(const std::function<LawCurve(const Eigen::VectorXd&)>& law, const Eigen::VectorXd& x,
                     const Eigen::MatrixXd& covariance, const Eigen::VectorXd& prior_sigma);

/// What people read of it: the range of its values, the width of its band, where it is the prior, what it looks like.
std::string in_words(const LearnedLaw& law);

}  // namespace ostium::data
