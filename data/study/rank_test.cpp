#include "data/study/rank_test.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ostium::data {

namespace {

/// Twice the rank of each value among all, from 2 on; equal ones share their mean rank. Twice, so that these are whole.
std::vector<std::size_t> doubled_ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size()), ranks(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    for (std::size_t k = from; k < to; ++k) ranks[order[k]] = from + to + 1;
  }
  return ranks;
}

/// Share of all choices of `count` ranks whose sum lies at least as far from the mean as `sum`.
double exact_p(const std::vector<std::size_t>& ranks, std::size_t count, std::size_t sum) {
  const std::size_t total = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  // chosen[k][s]: share of the choices so far that took k ranks of the sum s; each rank is taken or left.
  std::vector<std::vector<double>> chosen(count + 1, std::vector<double>(total + 1, 0));
  chosen[0][0] = 1;
  for (const std::size_t rank : ranks)
    for (std::size_t k = count; k > 0; --k)
      for (std::size_t s = total; s >= rank; --s) chosen[k][s] += chosen[k - 1][s - rank];
  const double mean = static_cast<double>(total) * static_cast<double>(count) / static_cast<double>(ranks.size());
  const double off = std::fabs(static_cast<double>(sum) - mean) - 1e-9;
  double all = 0, far = 0;
  for (std::size_t s = 0; s <= total; ++s) {
    all += chosen[count][s];
    if (std::fabs(static_cast<double>(s) - mean) >= off) far += chosen[count][s];
  }
  return far / all;
}

double normal_p(const std::vector<std::size_t>& ranks, std::size_t count, std::size_t sum) {
  const auto n = static_cast<double>(ranks.size()), a = static_cast<double>(count);
  const double mean = (n + 1) / 2;
  double spread = 0;  // of the ranks, which ties bring together
  for (const std::size_t rank : ranks) spread += std::pow(static_cast<double>(rank) / 2 - mean, 2);
  const double variance = a * (n - a) / (n * (n - 1)) * spread;
  if (variance == 0) return 1;
  return std::erfc(std::fabs(static_cast<double>(sum) / 2 - a * mean) / std::sqrt(2 * variance));
}

}  // namespace

RankTest rank_test(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const std::vector<std::size_t> ranks = doubled_ranks(all);
  const std::size_t sum =
      std::accumulate(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(a.size()), std::size_t{0});
  RankTest test;
  const auto n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
  test.u = static_cast<double>(sum) / 2 - n * (n + 1) / 2;
  test.superiority = test.u / (n * m);
  test.exact = all.size() <= most_exact;
  test.p = test.exact ? exact_p(ranks, a.size(), sum) : normal_p(ranks, a.size(), sum);
  return test;
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> out(p.size());
  double most = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    most = std::max(most, std::min(1.0, static_cast<double>(p.size() - k) * p[order[k]]));
    out[order[k]] = most;
  }
  return out;
}

}  // namespace ostium::data
