#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "data/assessment/page_parts.h"
#include "data/formats/markup.h"
#include "data/formats/plot.h"

namespace ostium::data {

namespace {

const char* const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
const char* colour(std::size_t i) { return colours[i % std::size(colours)]; }

/// One column, thinned to what a plot can show.
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

/// A plot of every column with this ending: all tools that move, all runs.
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

/// ECG, pressures and gauge around the last inflation, as the monitor showed them.
std::string inflation_strips(const ReportRun& run, bool named) {
  constexpr double before_s = 3, after_s = 10, longest_s = 60;
  double from_s = -1, to_s = -1;
  for (const RecordedEvent& e : events_of(run.record)) {
    if (e.code == EventCode::inflation_begins) from_s = e.time_s - before_s, to_s = e.time_s + longest_s;
    if (e.code == EventCode::deflated && from_s >= 0) to_s = std::min(to_s, e.time_s + after_s);
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

/// The plots in order; each shows the tools' signals of this name, or the patient's.
constexpr struct {
  const char *title, *signal, *unit;
} plots[] = {{"Length in the body", "inserted_mm", "mm"},
             {"Turned at the hub", "turned_deg", "degrees"},
             {"Force of the walls, at the tip", "tip_force_N", "N"},
             {"Force of the walls, in all", "wall_force_N", "N"},
             {"Push at the hand", "push_N", "N"},
             {"Torque at the hand", "torque_mNm", "mN m"},
             {"Pressure of the guide", "guide_mmHg", "mmHg"},
             {"ST shift", "ST_mV", "mV"},
             {"Inflation device", "gauge_atm", "atm"},
             {"Balloon, widest", "balloon_mm", "mm"},
             {"Smallest diameter of the lesion", "lesion_mld_mm", "mm"},
             {"Contrast", "contrast_mL", "mL"}};

}  // namespace

std::string time_plots(const std::vector<ReportRun>& runs) {
  std::string out = "<h2>Over time</h2>\n";
  for (const auto& [title, signal, unit] : plots) out += plot_of(runs, title, signal, unit);
  for (const ReportRun& run : runs) out += inflation_strips(run, runs.size() > 1);
  return out;
}

}  // namespace ostium::data
