#pragma once
/// The parts of a report page, as HTML.
#include "data/assessment/page.h"

namespace ostium::data {

/// What happened over time: one plot per signal, and the last inflation as the monitor showed it.
std::string time_plots(const std::vector<ReportRun>& runs);

/// When each stage that all runs have began, and how long it took; empty for one run.
std::string stages_table(const std::vector<ReportRun>& runs);
std::string metrics_table(const std::vector<ReportRun>& runs);
std::string score_table(const std::vector<ReportRun>& runs, const ScoreList& list);
std::string handling_table(const ReportRun& run);  ///< handling errors: what, when, and their definitions
std::string events_table(const ReportRun& run);    ///< the first 400

/// The event's tool; empty if it has none.
std::string tool_of(const ReportRun& run, const RecordedEvent& event);
/// What a mark says; empty for other events.
std::string mark_of(const ReportRun& run, const RecordedEvent& event);

}  // namespace ostium::data
