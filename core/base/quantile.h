#pragma once
#include <algorithm>
#include <limits>
#include <vector>

namespace ostium::core {

/// The value below which `share` of them lie, in [0, 1]: between neighbours by straight lines (Hyndman and Fan, Am
/// Stat 1996;50:361, type 7). NaN of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(low);
  std::nth_element(values.begin(), nth, values.end());
  if (low + 1 == values.size()) return *nth;
  return *nth + (at - static_cast<double>(low)) * (*std::min_element(nth + 1, values.end()) - *nth);
}
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace ostium::core
