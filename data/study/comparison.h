#pragma once
/// What a study says: each metric by group, how sure a difference is, and how well a trial tells of the next.
#include <optional>

#include "data/study/agreement.h"
#include "data/study/rank_test.h"
#include "data/study/study.h"

namespace ostium::data {

/// Of a group's participants, each with the median of his or her trials.
struct GroupNumbers {
  std::vector<double> values;            ///< one of each participant who has any
  double median = 0, low = 0, high = 0;  ///< and quartiles; NaN of none
};

/// Two groups, by index; `holm`: p corrected for all metrics that are compared in this case.
struct GroupPair {
  std::size_t a = 0, b = 0;
  RankTest test;
  double holm = 1;
};

struct ComparedMetric {
  std::string name;
  std::vector<GroupNumbers> groups;           ///< in the study's order
  std::vector<GroupPair> pairs;               ///< those whose groups have values
  std::optional<Agreement> agreement;         ///< over trials; none where too few made the same, or do not differ
  std::vector<std::vector<double>> by_trial;  ///< [group][trial] medians; NaN: of none
};

struct ComparedCase {
  std::string case_name;
  int trials = 0;                            ///< the most that anybody made
  std::vector<ComparedMetric> metrics;       ///< those that differ between runs
  std::vector<std::string> same_everywhere;  ///< the others
};

/// In the order of the study's cases and metrics. Agreement is of participants who made all of the first `trials`
/// trials that most of them made.
std::vector<ComparedCase> compare(const Study& study);

/// Answers to one statement: how many of each, from 1 to 5, by group.
struct AnsweredStatement {
  std::string part, statement;
  std::vector<std::vector<int>> counts;  ///< [group][answer - 1]
  double median = 0;                     ///< of all
};
std::vector<AnsweredStatement> statements_of(const Study& study);

}  // namespace ostium::data
