#include <fmt/format.h>

#include <cmath>

#include "data/assessment/page_parts.h"
#include "data/formats/csv.h"

namespace ostium::data {

std::string report_csv(const std::vector<ReportRun>& runs, const ScoreList& list) {
  std::string out = "code,case,script,seed,outcome,reason,simulated_s";
  for (const MetricDefinition& m : metric_definitions()) out += "," + m.name;
  for (const ScoreItem& item : list.items) out += "," + csv_field("item_" + item.id);
  out += "\n";
  for (const ReportRun& run : runs) {
    out += fmt::format("{},{},{},{},{},{},{:.3f}", csv_field(run.code), csv_field(run.case_name), csv_field(run.script),
                       run.seed, run.outcome, csv_field(run.reason), run.simulated_s);
    for (const MetricDefinition& m : metric_definitions()) {
      out += ",";
      for (const Metric& metric : run.metrics)
        if (metric.name == m.name && std::isfinite(metric.value)) out += fmt::format("{:.9g}", metric.value);
    }
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const Ticked holds = i < run.scores.size() ? run.scores[i].holds : Ticked::not_seen;
      out += holds == Ticked::not_seen ? "," : holds == Ticked::yes ? ",1" : ",0";
    }
    out += "\n";
  }
  return out;
}

std::string events_csv(const ReportRun& run) {
  std::string out = "time_s,event,tool,value,meaning,handling,text\n";
  for (const RecordedEvent& e : events_of(run.record)) {
    const EventDefinition* d = definition_of(e.code);
    if (!d) continue;
    const std::string tool = tool_of(run, e);
    out += fmt::format("{:.3f},{},{},{},{},{},{}\n", e.time_s, d->name, tool.empty() ? "" : csv_field(tool),
                       d->value.empty() ? "" : fmt::format("{:.6g}", e.value), csv_field(d->value),
                       severity_name(d->severity), csv_field(mark_of(run, e)));
  }
  return out;
}

}  // namespace ostium::data
