#pragma once
/// How far what one participant does in one trial says what he or she does in the next: the intraclass correlation of
/// Shrout and Fleiss (1979), Psychol. Bull. 86:420.
#include <vector>

namespace ostium::data {

struct Agreement {
  double icc = 0;            ///< ICC(2,1): two-way random effects, absolute agreement, of a single trial
  double low = 0, high = 0;  ///< its interval of 95 %
  double consistency = 0;    ///< ICC(3,1): the same without what all gain from trial to trial
  std::size_t participants = 0, trials = 0;
};

/// values[participant][trial]: at least 2 of at least 2, equally many of each. Where all are equal, 0.
Agreement agreement(const std::vector<std::vector<double>>& values);

}  // namespace ostium::data
