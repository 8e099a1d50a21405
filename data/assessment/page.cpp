#include "data/assessment/page.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/ofstd/ofstd.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "data/formats/plot.h"

namespace ostium {

namespace {

const char* const style = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #222; max-width: 1080px; margin: 24px auto; padding: 0 16px; }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 17px; margin: 30px 0 8px; }
.small, .note { color: #666; font-size: 13px; }
.note { border: 1px solid #ddd; padding: 6px 12px; background: #fafafa; }
table { border-collapse: collapse; font-size: 14px; } th { text-align: left; font-weight: 600; vertical-align: bottom; }
th, td { padding: 3px 14px 3px 0; border-bottom: 1px solid #e8e8e8; vertical-align: top; }
td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.yes { color: #00724f; } .no { color: #c0392b; font-weight: 600; } .open { color: #999; }
svg { max-width: 100%; height: auto; margin: 4px 6px 4px 0; }
figure { display: inline-block; margin: 0 8px 10px 0; width: 250px; vertical-align: top; } figure img { width: 250px; }
figcaption { font-size: 12px; color: #555; }
figure.plot { width: 525px; } figure.plot figcaption { font-size: 14px; font-weight: 600; color: #222; }
)";

const char* const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
const char* colour(std::size_t i) { return colours[i % std::size(colours)]; }

std::string time_text(double s) {
  return fmt::format("{}:{:04.1f}", static_cast<int>(s) / 60, s - 60 * (static_cast<int>(s) / 60));
}

std::string data_uri(const std::vector<std::uint8_t>& png) {
  OFString text;
  OFStandard::encodeBase64(png.data(), png.size(), text);
  return "data:image/png;base64," + std::string(text.c_str());
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "&ndash;"; }

/// Of one column, thinned to what a plot shows.
Plot::Points series(const RunRecord& r, std::size_t column) {
  constexpr std::size_t most = 900;
  Plot::Points points;
  const std::size_t w = r.signal_columns.size(), stride = std::max<std::size_t>(1, r.rows() / most);
  for (std::size_t row = 0; row < r.rows(); row += stride) {
    const double value = r.signals[row * w + column];
    if (std::isfinite(value)) points.emplace_back(r.signals[row * w], value);
  }
  return points;
}

/// A plot of every column with this ending: of all tools that move, of all runs.
std::string plot_of(const std::vector<ReportRun>& runs, const std::string& title, const std::string& ending,
                    const std::string& unit) {
  Plot plot("", "time, s", unit, 520, 230);
  bool any = false;
  std::size_t next = 0;
  for (const ReportRun& run : runs)
    for (std::size_t c = 0; c < run.record.signal_columns.size(); ++c) {
      const std::string& name = run.record.signal_columns[c];
      if (name != ending && !name.ends_with("." + ending)) continue;
      const Plot::Points points = series(run.record, c);
      if (points.size() < 2) continue;
      const auto [low, high] =
          std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); });
      if (high->y() - low->y() < 1e-9) continue;
      plot.line(points, colour(next), 1.2);
      std::string words = name == ending ? "" : name.substr(0, name.size() - ending.size() - 1);
      if (runs.size() > 1) words = run.code + (words.empty() ? "" : ", " + words);
      if (!words.empty()) plot.legend(words, colour(next));
      ++next, any = true;
    }
  return any ? "<figure class=\"plot\"><figcaption>" + escaped(title) + "</figcaption>" + plot.svg() + "</figure>\n"
             : "";
}

/// ECG, pressures and gauge about the last inflation, as a monitor had them.
std::string inflation_strips(const ReportRun& run, bool named) {
  constexpr double before_s = 3, after_s = 10, longest_s = 60;
  double from_s = -1, to_s = -1;
  for (std::size_t e = 0; e + 3 < run.record.events.size(); e += 4) {
    const auto code = static_cast<EventCode>(static_cast<int>(run.record.events[e + 1]));
    const double time_s = run.record.events[e] * run.record.step_s;
    if (code == EventCode::inflation_begins) from_s = time_s - before_s, to_s = time_s + longest_s;
    if (code == EventCode::deflated && from_s >= 0) to_s = std::min(to_s, time_s + after_s);
  }
  if (from_s < 0) return "";
  std::string out;
  const std::size_t width = run.record.signal_columns.size();
  for (const auto& [name, title, unit] :
       {std::array{"ecg_II_mV", "II", "mV"}, std::array{"ecg_V2_mV", "V2", "mV"},
        std::array{"guide_mmHg", "Guide", "mmHg"}, std::array{"gauge_atm", "Gauge", "atm"}}) {
    const auto column = std::find(run.record.signal_columns.begin(), run.record.signal_columns.end(), name);
    if (column == run.record.signal_columns.end()) continue;
    const auto c = static_cast<std::size_t>(column - run.record.signal_columns.begin());
    Plot::Points points;
    for (std::size_t i = 0; i < run.record.rows(); ++i) {
      const double* row = run.record.signals.data() + i * width;
      if (row[0] >= from_s && row[0] <= to_s && std::isfinite(row[c])) points.emplace_back(row[0], row[c]);
    }
    if (points.size() < 2) continue;
    Plot plot("", std::string_view(name) == "gauge_atm" ? "time, s" : "", std::string(title) + ", " + unit, 1060, 130);
    plot.line(points, "#222", 0.8);
    out += plot.svg() + "\n";
  }
  return out.empty() ? ""
                     : "<figure><figcaption>" + (named ? escaped(run.code) + ": " : std::string()) +
                           "The last inflation, as the monitor had it</figcaption>" + out + "</figure>\n";
}

std::string header(const std::vector<ReportRun>& runs) {
  std::string out =
      "<table><tr><th>run</th><th>case</th><th>script</th><th>seed</th><th>outcome</th><th>simulated</th><th>made "
      "by</th></tr>\n";
  for (const ReportRun& run : runs)
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"{}\">{}{}</td><td "
        "class=\"n\">{}</td><td>{}</td></tr>\n",
        escaped(run.code), escaped(run.case_name), escaped(run.script), run.seed,
        run.outcome == "success" ? "yes" : "no", escaped(run.outcome),
        run.reason.empty() ? "" : ": " + escaped(run.reason), time_text(run.simulated_s), escaped(run.software));
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

std::string metrics_table(const std::vector<ReportRun>& runs) {
  std::string out = "<h2>Metrics</h2>\n<table><tr><th>metric</th>";
  for (const ReportRun& run : runs) out += "<th>" + escaped(run.code) + "</th>";
  out += "<th>unit</th><th>what it is</th></tr>\n";
  for (const MetricDefinition& definition : metric_definitions()) {
    out += "<tr><td>" + definition.name + "</td>";
    for (const ReportRun& run : runs) {
      const auto it = std::find_if(run.metrics.begin(), run.metrics.end(),
                                   [&](const Metric& m) { return m.name == definition.name; });
      out += "<td class=\"n\">" + (it == run.metrics.end() ? "&ndash;" : number(it->value)) + "</td>";
    }
    out += "<td>" + (definition.unit == "1" ? "" : definition.unit) + "</td><td class=\"small\">" +
           escaped(definition.definition) + "</td></tr>\n";
  }
  return out + "</table>\n";
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

/// Of the event at `e`; empty: none.
std::string tool_of(const ReportRun& run, std::size_t e) {
  const double tool = run.record.events[e + 2];
  return tool >= 0 && tool < static_cast<double>(run.tools.size()) ? run.tools[static_cast<std::size_t>(tool)] : "";
}

/// What went wrong, when, and what is meant by it.
std::string handling_table(const ReportRun& run) {
  std::string rows;
  for (std::size_t e = 0; e + 3 < run.record.events.size(); e += 4)
    for (const EventDefinition& d : event_definitions())
      if (d.severity != Severity::none && static_cast<int>(d.code) == static_cast<int>(run.record.events[e + 1]))
        rows += fmt::format(
            "<tr><td class=\"n\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"small\">{}</td></tr>\n",
            time_text(run.record.events[e] * run.record.step_s), severity_name(d.severity), d.name,
            escaped(tool_of(run, e)),
            d.value.empty()
                ? ""
                : fmt::format("{:.3g} <span class=\"small\">{}</span>", run.record.events[e + 3], escaped(d.value)),
            escaped(d.definition));
  return "<h2>Handling" + (run.code.empty() ? "" : " of " + escaped(run.code)) + "</h2>\n" +
         (rows.empty()
              ? "<p>No error of handling was found.</p>\n"
              : "<table><tr><th>time</th><th></th><th>error</th><th>tool</th><th>value</th><th>what it means (limits "
                "are a draft, not validated)</th></tr>\n" +
                    rows + "</table>\n");
}

std::string events_table(const ReportRun& run) {
  std::string out = "<h2>Events" + (run.code.empty() ? "" : " of " + escaped(run.code)) +
                    "</h2>\n<table><tr><th>time</th><th>event</th><th>value</th></tr>\n";
  constexpr std::size_t most = 400;
  std::size_t shown = 0;
  for (std::size_t e = 0; e + 3 < run.record.events.size() && shown < most; e += 4, ++shown) {
    const auto code = static_cast<int>(run.record.events[e + 1]);
    for (const EventDefinition& definition : event_definitions())
      if (static_cast<int>(definition.code) == code)
        out += fmt::format("<tr><td class=\"n\">{}</td><td title=\"{}\">{}</td><td>{}</td></tr>\n",
                           time_text(run.record.events[e] * run.record.step_s), escaped(definition.definition),
                           definition.name,
                           definition.value.empty() ? ""
                                                    : fmt::format("{:.4g} <span class=\"small\">{}</span>",
                                                                  run.record.events[e + 3], escaped(definition.value)));
  }
  return out + "</table>\n";
}

const char* const save_script = R"(<script>
function save(id, name) {
  const rows = [...document.querySelectorAll('#' + id + ' tr')].map(row => [...row.cells].map(cell => {
    const box = cell.querySelector('input[type=checkbox]'), pick = cell.querySelector('input[type=radio]:checked'),
          text = cell.querySelector('textarea, input[type=text]');
    const value = box ? (box.checked ? '1' : '0') : pick ? pick.value : text ? text.value :
                  cell.querySelector('input') ? '' : cell.innerText;
    return '"' + value.replace(/"/g, '""').replace(/\n/g, ' ') + '"';
  }).join(','));
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([rows.join('\n') + '\n'], { type: 'text/csv' }));
  link.download = name;
  link.click();
}
</script>
)";

std::string page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\">\n<title>" +
         escaped(title) + "</title><style>" + style + "</style>" + save_script + "</head><body>\n<h1>" +
         escaped(title) + "</h1>\n<p class=\"note\">Training and research, not for decisions on a patient.</p>\n" +
         body + "</body></html>\n";
}

std::string quoted(const std::string& words) {
  std::string out = "\"";
  for (const char c : words) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::string report_page(const std::vector<ReportRun>& runs, const ScoreList& list) {
  std::string body = header(runs) + pictures(runs);
  body += "<h2>Over time</h2>\n";
  body += plot_of(runs, "Length in the body", "inserted_mm", "mm") +
          plot_of(runs, "Turned at the hub", "turned_deg", "degrees");
  body += plot_of(runs, "Force of the walls, at the tip", "tip_force_N", "N") +
          plot_of(runs, "Force of the walls, in all", "wall_force_N", "N");
  body += plot_of(runs, "Push at the hand", "push_N", "N") + plot_of(runs, "Torque at the hand", "torque_mNm", "mN m");
  body += plot_of(runs, "Pressure of the guide", "guide_mmHg", "mmHg") + plot_of(runs, "ST shift", "ST_mV", "mV");
  body += plot_of(runs, "Inflation device", "gauge_atm", "atm") + plot_of(runs, "Balloon, widest", "balloon_mm", "mm");
  body += plot_of(runs, "Smallest diameter of the lesion", "lesion_mld_mm", "mm") +
          plot_of(runs, "Contrast", "contrast_mL", "mL");
  for (const ReportRun& run : runs) body += inflation_strips(run, runs.size() > 1);
  body += metrics_table(runs) + score_table(runs, list);
  for (const ReportRun& run : runs) body += handling_table(run);
  for (const ReportRun& run : runs) body += events_table(run);
  return page(runs.size() == 1 ? "Run of " + runs[0].case_name : fmt::format("{} runs", runs.size()), body);
}

std::string report_csv(const std::vector<ReportRun>& runs, const ScoreList& list) {
  std::string out = "code,case,script,seed,outcome,reason,simulated_s";
  for (const MetricDefinition& m : metric_definitions()) out += "," + m.name;
  for (const ScoreItem& item : list.items) out += "," + quoted("item_" + item.id);
  out += "\n";
  for (const ReportRun& run : runs) {
    out += fmt::format("{},{},{},{},{},{},{:.3f}", quoted(run.code), quoted(run.case_name), quoted(run.script),
                       run.seed, run.outcome, quoted(run.reason), run.simulated_s);
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
  const RunRecord& record = run.record;
  std::string out = "time_s,event,tool,value,meaning,handling\n";
  for (std::size_t e = 0; e + 3 < record.events.size(); e += 4) {
    const auto code = static_cast<int>(record.events[e + 1]);
    for (const EventDefinition& definition : event_definitions())
      if (static_cast<int>(definition.code) == code)
        out += fmt::format("{:.3f},{},{},{},{},{}\n", record.events[e] * record.step_s, definition.name,
                           tool_of(run, e).empty() ? "" : quoted(tool_of(run, e)),
                           definition.value.empty() ? "" : fmt::format("{:.6g}", record.events[e + 3]),
                           quoted(definition.value), severity_name(definition.severity));
  }
  return out;
}

std::string questionnaire_page() {
  static const char* const face[] = {
      "The picture looks like one of the catheter laboratory.",
      "Wire and catheter move in the picture as they do in a patient.",
      "Turning the guide feels as it does in a patient, with its lag and its jump.",
      "The heart's beat, and how it moves instruments, is believable.",
      "Contrast fills, streams back and washes out as in life.",
      "The balloon opens the narrowing as in life.",
      "ECG and pressure answer when a vessel is closed.",
      "The order of work is that of the laboratory.",
  };
  static const char* const content[] = {
      "It trains engaging an ostium.",
      "It trains crossing a lesion with a wire.",
      "It trains holding two instruments still while a third one slides.",
      "It trains choosing sizes of balloons and stents.",
      "It trains placing a stent, with its margins.",
      "It trains spending little radiation and contrast.",
      "What it counts as an error is one.",
      "Somebody who has trained here would be safer in their first cases.",
  };
  const auto table = [](const char* id, const char* const* items, std::size_t count) {
    std::string out = fmt::format(
        "<table id=\"{}\"><tr><th>statement</th><th>1 (not at all) to 5 (fully)</th><th>remark</th></tr>\n", id);
    for (std::size_t i = 0; i < count; ++i) {
      out += "<tr><td>" + escaped(items[i]) + "</td><td>";
      for (int k = 1; k <= 5; ++k)
        out += fmt::format("<label><input type=\"radio\" name=\"{}{}\" value=\"{}\"> {}</label> ", id, i, k, k);
      out += "</td><td><input type=\"text\"></td></tr>\n";
    }
    return out + fmt::format("</table>\n<p><button onclick=\"save('{0}','{0}.csv')\">Save as CSV</button></p>\n", id);
  };
  return page("Questionnaires",
              "<p>Participant code (no name): <input type=\"text\"> &nbsp; procedures done as first operator: <input "
              "type=\"text\"></p>\n<h2>Does it look and feel right? (face)</h2>\n" +
                  table("face", face, std::size(face)) + "<h2>Does it train what is needed? (content)</h2>\n" +
                  table("content", content, std::size(content)));
}

}  // namespace ostium
