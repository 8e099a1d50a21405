#pragma once
/// What each input may be, for callers that are not ours: Python programs, learners.
#include <string>
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

struct InputRange {
  double least = 0, most = 0;  ///< SI, as the name says; core limits drives to this, too
  /// Given at once rather than for as long as it lasts: a drug. In a call of many steps the first one gives it.
  bool dose = false;
};

/// One for each of input_names.
std::vector<InputRange> input_ranges(const SessionModel& model);

/// "wire.advance_m_s is nan; expected a number from -2 to 2" for the first input out of its range; else empty. Drives
/// of tools are taken as they come: core limits them, and says so as trouble.
std::string first_out_of_range(const std::vector<std::string>& names, const std::vector<InputRange>& ranges,
                               const double* row);

}  // namespace ostium::app
