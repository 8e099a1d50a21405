#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/assessment/html.h"
#include "data/assessment/page_parts.h"
#include "data/assessment/stages.h"
#include "data/formats/markup.h"

namespace ostium::data {

namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "&ndash;"; }
std::string number(const Metric& metric) {
  return metric.unit == "s" && metric.value >= never_s ? "never" : number(metric.value);
}

std::string score_cell(const ScoreItem& item, const Score& score) {
  if (score.holds == Ticked::not_seen) return "<td class=\"open\"><input type=\"checkbox\"> not seen</td>";
  const bool holds = score.holds == Ticked::yes;
  const bool step = item.kind == ScoreKind::step;
  std::string words = step ? (holds ? "done" : "not done") : (holds ? "none" : "happened");
  if (!score.value.empty()) words += ", " + score.value;
  for (std::size_t i = 0; i < std::min<std::size_t>(score.at_s.size(), 6); ++i)
    words += (i ? ", " : " at ") + time_text(score.at_s[i]);
  if (score.at_s.size() > 6) words += fmt::format(" and {} more", score.at_s.size() - 6);
  return fmt::format("<td class=\"{}\"><input type=\"checkbox\"{}> {}</td>", holds ? "yes" : "no",
                     holds ? " checked" : "", escaped(words));
}

/// "of <run>" if runs have names.
std::string of_run(const ReportRun& run) { return run.code.empty() ? "" : " of " + escaped(run.code); }

}  // namespace

std::string stages_table(const std::vector<ReportRun>& runs) {
  if (runs.size() < 2) return "";
  const std::vector<Stage> stages = common_stages(runs);
  std::string out =
      "<h2>Stages</h2>\n<p class=\"note\">What happened in all runs, in this order.</p>\n<table><tr><th>stage</th>";
  for (const ReportRun& run : runs)
    out += fmt::format("<th>{0}: begins at</th><th>{0}: takes, s</th>", escaped(run.code));
  out += "</tr>\n";
  for (std::size_t k = 0; k < stages.size(); ++k) {
    out += "<tr><td>" + escaped(stages[k].name) + "</td>";
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const double begin_s = stages[k].begin_s[r],
                   end_s = k + 1 < stages.size() ? stages[k + 1].begin_s[r] : runs[r].simulated_s;
      out += fmt::format("<td class=\"n\">{}</td><td class=\"n\">{:.1f}</td>", time_text(begin_s), end_s - begin_s);
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string metrics_table(const std::vector<ReportRun>& runs) {
  std::string out = "<h2>Metrics</h2>\n<table><tr><th>metric</th>";
  for (const ReportRun& run : runs) out += "<th>" + escaped(run.code) + "</th>";
  out += "<th>unit</th><th>what it is</th></tr>\n";
  for (const MetricDefinition& definition : metric_definitions()) {
    out += "<tr><td>" + definition.name + "</td>";
    for (const ReportRun& run : runs) {
      const auto it = std::find_if(run.metrics.begin(), run.metrics.end(),
                                   [&](const Metric& m) { return m.name == definition.name; });
      out += "<td class=\"n\">" + (it == run.metrics.end() ? "&ndash;" : number(*it)) + "</td>";
    }
    out += "<td>" + (definition.unit == "1" ? "" : definition.unit) + "</td><td class=\"small\">" +
           escaped(definition.definition) + "</td></tr>\n";
  }
  return out + "</table>\n";
}

std::string score_table(const std::vector<ReportRun>& runs, const ScoreList& list) {
  if (list.items.empty()) return "";
  std::string out =
      "<h2>" + escaped(list.title) + "</h2>\n<p class=\"note\">" + escaped(list.note) +
      " Ticked by the program where a recording can tell; a rater may change every box and save the list.</p>\n"
      "<table id=\"score\"><tr><th></th><th>phase</th><th></th><th>what</th>";
  for (const ReportRun& run : runs) out += "<th>" + escaped(run.code) + "</th>";
  out += "</tr>\n";
  const char* kinds[] = {"step", "error", "critical"};
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const ScoreItem& item = list.items[i];
    out += "<tr><td>" + escaped(item.id) + "</td><td>" + escaped(item.phase) + "</td><td>" +
           kinds[static_cast<int>(item.kind)] + "</td><td>" + escaped(item.what) + "<br><span class=\"small\">" +
           escaped(item.when) + "</span></td>";
    for (const ReportRun& run : runs) out += score_cell(item, i < run.scores.size() ? run.scores[i] : Score{});
    out += "</tr>\n";
  }
  return out + "</table>\n<p><button onclick=\"save('score','scores.csv')\">Save the list as CSV</button></p>\n";
}

std::string mark_of(const ReportRun& run, const RecordedEvent& event) {
  if (event.code != EventCode::mark || !(event.value >= 0)) return "";
  const auto step = static_cast<std::size_t>(event.value);
  return step < run.marks.size() ? run.marks[step] : "";
}

std::string tool_of(const ReportRun& run, const RecordedEvent& event) {
  const auto i = static_cast<std::size_t>(event.tool);
  return event.tool >= 0 && i < run.tools.size() ? run.tools[i] : "";
}

std::string handling_table(const ReportRun& run) {
  std::string rows;
  for (const RecordedEvent& e : events_of(run.record)) {
    const EventDefinition* d = definition_of(e.code);
    if (!d || d->severity == Severity::none) continue;
    rows += fmt::format(
        "<tr><td class=\"n\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"small\">{}</td></tr>\n",
        time_text(e.time_s), severity_name(d->severity), d->name, escaped(tool_of(run, e)),
        d->value.empty() ? "" : fmt::format("{:.3g} <span class=\"small\">{}</span>", e.value, escaped(d->value)),
        escaped(d->definition));
  }
  return "<h2>Handling" + of_run(run) + "</h2>\n" +
         (rows.empty()
              ? "<p>No error of handling was found.</p>\n"
              : "<table><tr><th>time</th><th></th><th>error</th><th>tool</th><th>value</th><th>what it means (limits "
                "are a draft, not validated)</th></tr>\n" +
                    rows + "</table>\n");
}

namespace {

/// ": what a mark says"
std::string says(const ReportRun& run, const RecordedEvent& event) {
  const std::string mark = mark_of(run, event);
  return mark.empty() ? "" : ": " + escaped(mark);
}

}  // namespace

std::string events_table(const ReportRun& run) {
  constexpr std::size_t most = 400;
  std::string out = "<h2>Events" + of_run(run) + "</h2>\n<table><tr><th>time</th><th>event</th><th>value</th></tr>\n";
  std::vector<RecordedEvent> events = events_of(run.record);
  const std::size_t more = events.size() - std::min(events.size(), most);
  events.resize(events.size() - more);
  for (const RecordedEvent& e : events)
    if (const EventDefinition* d = definition_of(e.code))
      out += fmt::format(
          "<tr><td class=\"n\">{}</td><td title=\"{}\">{}{}</td><td>{}</td></tr>\n", time_text(e.time_s),
          escaped(d->definition), d->name, says(run, e),
          d->value.empty() ? "" : fmt::format("{:.4g} <span class=\"small\">{}</span>", e.value, escaped(d->value)));
  if (more > 0) out += fmt::format("<tr><td></td><td>and {} more, in events.csv</td><td></td></tr>\n", more);
  return out + "</table>\n";
}

}  // namespace ostium::data
