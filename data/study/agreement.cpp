#include "data/study/agreement.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cassert>
#include <cmath>

namespace ostium::data {

namespace {

/// Mean squares of a table without repetitions: between rows, between columns, and what is left.
struct MeanSquares {
  double rows = 0, columns = 0, rest = 0;
};

MeanSquares mean_squares(const std::vector<std::vector<double>>& x) {
  const auto n = static_cast<double>(x.size()), k = static_cast<double>(x.front().size());
  double mean = 0;
  std::vector<double> by_row(x.size(), 0), by_column(x.front().size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x[i].size(); ++j)
      mean += x[i][j] / (n * k), by_row[i] += x[i][j] / k, by_column[j] += x[i][j] / n;
  MeanSquares out;
  for (const double row : by_row) out.rows += k * std::pow(row - mean, 2) / (n - 1);
  for (const double column : by_column) out.columns += n * std::pow(column - mean, 2) / (k - 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x[i].size(); ++j)
      out.rest += std::pow(x[i][j] - by_row[i] - by_column[j] + mean, 2) / ((n - 1) * (k - 1));
  return out;
}

double upper_F(double a, double b) { return quantile(boost::math::fisher_f(a, b), 0.975); }

}  // namespace

Agreement agreement(const std::vector<std::vector<double>>& values) {
  assert(values.size() >= 2 && values.front().size() >= 2);
  Agreement out{.participants = values.size(), .trials = values.front().size()};
  const auto n = static_cast<double>(out.participants), k = static_cast<double>(out.trials);
  const MeanSquares m = mean_squares(values);
  const double total = m.rows + (k - 1) * m.rest + k * (m.columns - m.rest) / n;
  double largest = 0;
  for (const std::vector<double>& row : values)
    for (const double x : row) largest = std::max(largest, std::fabs(x));
  const double rounding = std::pow(1e-12 * largest, 2);
  if (!(m.rows > rounding) || !(total > rounding) || !std::isfinite(total)) return out;
  out.icc = (m.rows - m.rest) / total;
  out.consistency = (m.rows - m.rest) / (m.rows + (k - 1) * m.rest);
  if (!(m.rest > rounding)) {
    out.low = out.high = out.icc;
    return out;
  }
  // Satterthwaite's degrees of freedom of what the columns and the rest share.
  const double columns = m.columns / m.rest, part = n * (1 + (k - 1) * out.icc) - k * out.icc;
  const double freedom = (k - 1) * (n - 1) * std::pow(k * out.icc * columns + part, 2) /
                         ((n - 1) * std::pow(k * out.icc * columns, 2) + part * part);
  if (!(freedom > 0) || !std::isfinite(freedom)) return out;
  const double up = upper_F(n - 1, freedom), down = upper_F(freedom, n - 1),
               rest = k * m.columns + (k * n - k - n) * m.rest;
  const double low = n * (m.rows - up * m.rest) / (up * rest + n * m.rows),
               high = n * (down * m.rows - m.rest) / (rest + n * down * m.rows);
  if (low <= out.icc && out.icc <= high && std::isfinite(high - low)) out.low = low, out.high = high;
  return out;
}

}  // namespace ostium::data
