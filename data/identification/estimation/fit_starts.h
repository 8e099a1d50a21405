#pragma once
/// Where fits begin.
#include "data/identification/estimation/parameters.h"

namespace ostium::data {

/// `from`, and `count` points more whose numbers from `first` on (ten at most) are spread over the middle of their
/// priors, so that a rugged landscape is not taken for its first valley.
std::vector<Eigen::VectorXd> starts_of(const Parameters& parameters, const Eigen::VectorXd& from, int first, int count);

}  // namespace ostium::data
