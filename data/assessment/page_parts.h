#pragma once
/// The parts that a report's page consists of, as HTML.
#include "data/assessment/page.h"

namespace ostium::data {

/// What happened over time: a plot a signal, and the last inflation as the monitor had it.
std::string time_plots(const std::vector<ReportRun>& runs);

std::string metrics_table(const std::vector<ReportRun>& runs);
std::string score_table(const std::vector<ReportRun>& runs, const ScoreList& list);
std::string handling_table(const ReportRun& run);  ///< what went wrong, when, and what is meant by it
std::string events_table(const ReportRun& run);    ///< the first 400

/// The event's tool; empty: it has none.
std::string tool_of(const ReportRun& run, const RecordedEvent& event);

}  // namespace ostium::data
