#include "data/identification/estimation/fit_starts.h"

#include <algorithm>

namespace ostium::data {

namespace {

/// Low-discrepancy (Halton) numbers from 0 to 1, number `k` of sequence `i`.
double halton(int k, int i) {
  constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
  double h = 0, f = 1;
  for (int n = k; n > 0; n /= primes[i % 10]) h += (f /= primes[i % 10]) * (n % primes[i % 10]);
  return h;
}

}  // namespace

std::vector<Eigen::VectorXd> starts_of(const Parameters& parameters, const Eigen::VectorXd& from, int first,
                                       int count) {
  std::vector<Eigen::VectorXd> starts = {from};
  for (int k = 1; k <= count; ++k) {
    Eigen::VectorXd x = from;
    for (int i = first; i < std::min(parameters.shape_parameters(), first + 10); ++i)
      x[i] = parameters.within(i, halton(k, i - first));
    starts.push_back(x);
  }
  return starts;
}

}  // namespace ostium::data
