#pragma once
/// One run, or several side by side, as a self-contained page and as a table for statistics packages.
#include <cstdint>
#include <string>
#include <vector>

#include "data/assessment/metrics.h"
#include "data/assessment/score_list.h"

namespace ostium::data {

struct ReportPicture {
  std::string caption;
  std::vector<std::uint8_t> png;
};

struct ReportRun {
  std::string code;  ///< identifies the participant or the attempt; never a name
  std::string case_name, script, outcome, reason, software;
  std::uint64_t seed = 0;
  double simulated_s = 0;
  std::vector<std::string> tools;  ///< names
  std::vector<std::string> marks;  ///< what a mark says, by step of the script
  RunRecord record;
  std::vector<Metric> metrics;
  std::vector<Score> scores;  ///< one for each item of the list
  std::vector<ReportPicture> pictures;
};

/// HTML. `runs`: at least one.
std::string report_page(const std::vector<ReportRun>& runs, const ScoreList& list);
/// One row per run: code, case, script, seed, outcome, then every metric and every item of the list (1 met, 0 not met,
/// empty: cannot be told from the recording).
std::string report_csv(const std::vector<ReportRun>& runs, const ScoreList& list);
/// A run's events: time, name, tool, value with its meaning, "error" or "critical" for handling errors, and what a mark
/// says.
std::string events_csv(const ReportRun& run);

/// The face and content validity questionnaires of a validation study, as a page with forms whose answers are saved as
/// CSV.
std::string questionnaire_page();

}  // namespace ostium::data
