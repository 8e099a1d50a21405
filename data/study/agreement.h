#pragma once
/// How far what one participant does in one trial says what he or she does in the next: the intraclass correlation of
/// Shrout and Fleiss (1979), Psychol. Bull. 86:420.
#include <limits>
#include <vector>

namespace ostium::data {

struct Agreement {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double icc = none;               ///< ICC(2,1): two-way random effects, absolute agreement, of a single trial
  double low = none, high = none;  ///< its interval of 95 %; NaN where these trials give none
  double consistency = none;       ///< ICC(3,1): the same without what all gain from trial to trial
  std::size_t participants = 0, trials = 0;
};

/// values[participant][trial]: at least 2 of at least 2, equally many of each. NaN where participants do not differ.
Agreement agreement(const std::vector<std::vector<double>>& values);

}  // namespace ostium::data
