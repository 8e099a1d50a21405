#pragma once
/// Starting points of fits.
#include "data/identification/estimation/parameters.h"

namespace ostium::data {

/// `from`, followed by `count` more points whose numbers from `first` on (ten at most) are spread over the middle of
/// their priors, so that the fit does not settle for the first local minimum.
std::vector<Eigen::VectorXd> starts_of(const Parameters& parameters, const Eigen::VectorXd& from, int first, int count);

}  // namespace ostium::data
