#pragma once
/// Whether two groups differ: the test of Mann and Whitney (1947), Ann. Math. Stat. 18:50.
#include <vector>

namespace ostium::data {

struct RankTest {
  double u = 0;            ///< pairs in which the first group's value is larger; equal ones count half
  double superiority = 0;  ///< the same as a share of all pairs; 0.5: no difference
  double p = 1;            ///< two-sided: of a rank sum at least as far from its mean, if the groups are one
  bool exact = true;       ///< else by the normal distribution, with its variance corrected for ties
};

inline constexpr std::size_t most_exact = 80;  ///< values in both groups together, for an exact p

/// Values are finite; neither group is empty. Exact also where values are equal: over all ways to choose as many of the
/// ranks as there are (the shift algorithm of Streitberg and Roehmel 1986, Stat. Software Newsl. 12:10).
RankTest rank_test(const std::vector<double>& a, const std::vector<double>& b);

/// Holm's correction for several tests (1979), Scand. J. Stat. 6:65; in the order given.
std::vector<double> holm(const std::vector<double>& p);

}  // namespace ostium::data
