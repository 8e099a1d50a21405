#include "data/assessment/page.h"

#include <fmt/format.h>

#include "data/assessment/html.h"
#include "data/assessment/page_parts.h"
#include "data/formats/markup.h"

namespace ostium::data {

namespace {

std::string header(const std::vector<ReportRun>& runs) {
  std::string out =
      "<table><tr><th>run</th><th>case</th><th>script</th><th>seed</th><th>outcome</th><th>simulated</th><th>made "
      "by</th></tr>\n";
  for (const ReportRun& run : runs)
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"{}\">{}{}</td><td "
        "class=\"n\">{}</td><td>{}</td></tr>\n",
        escaped(run.code), escaped(run.case_name), escaped(run.script), run.seed,
        run.outcome == "success" ? "yes"
        : run.outcome == "ended" ? ""
                                 : "no",
        escaped(run.outcome), run.reason.empty() ? "" : ": " + escaped(run.reason), time_text(run.simulated_s),
        escaped(run.software));
  return out + "</table>\n";
}

std::string pictures(const std::vector<ReportRun>& runs) {
  std::string out;
  for (const ReportRun& run : runs)
    for (const ReportPicture& p : run.pictures)
      out += "<figure><img alt=\"" + escaped(p.caption) + "\" src=\"" + data_uri(p.png) + "\"><figcaption>" +
             escaped(runs.size() > 1 ? run.code + ": " + p.caption : p.caption) + "</figcaption></figure>\n";
  return out.empty() ? "" : "<h2>Pictures</h2>\n" + out;
}

}  // namespace

std::string report_page(const std::vector<ReportRun>& runs, const ScoreList& list) {
  std::string body = header(runs) + pictures(runs) + time_plots(runs) + stages_table(runs) + metrics_table(runs) +
                     score_table(runs, list);
  for (const ReportRun& run : runs) body += handling_table(run);
  for (const ReportRun& run : runs) body += events_table(run);
  return html_page(runs.size() == 1 ? "Run of " + runs[0].case_name : fmt::format("{} runs", runs.size()), body);
}

}  // namespace ostium::data
