#pragma once
/// Building blocks for the rows of the metric tables: each returns a metric's function.
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "data/assessment/run_record.h"

namespace ostium::data {

using MetricFunction = std::function<double(const RunRecord&)>;

inline constexpr double does_not_apply = std::numeric_limits<double>::quiet_NaN();

/// How often the event occurred.
inline MetricFunction count_of(EventCode code) {
  return [code](const RunRecord& r) { return static_cast<double>(events_of(r, code).size()); };
}

/// The signal's last value.
inline MetricFunction last(const std::string& signal, double factor = 1) {
  return [=](const RunRecord& r) { return factor * last_of(r, signal); };
}

/// The signal's largest value, at least 0; rows in which it is not a number are left out.
inline MetricFunction most(const std::string& signal) {
  return [signal](const RunRecord& r) {
    const std::vector<double> column = all_of(r, signal);
    if (column.empty()) return does_not_apply;
    double most = 0;
    for (const double x : column) most = x > most ? x : most;
    return most;
  };
}

/// Time for which the signal lies in [least, below).
inline MetricFunction time_within(const std::string& signal, double least, double below) {
  return [=](const RunRecord& r) {
    const std::vector<double> column = all_of(r, signal);
    if (column.empty()) return does_not_apply;
    double sum = 0;
    for (const double x : column) sum += x >= least && x < below ? row_spacing_s(r) : 0;
    return sum;
  };
}

}  // namespace ostium::data
