#include "data/assessment/stages.h"

#include <algorithm>

#include "data/assessment/page_parts.h"

namespace ostium::data {

namespace {

struct Milestone {
  std::string name;
  double at_s = 0;
};

std::string words(EventCode code) {
  switch (code) {
    case EventCode::tool_in:
      return " in";
    case EventCode::tool_out:
      return " out";
    case EventCode::heparin:
      return "heparin";
    case EventCode::inflation_begins:
      return "inflation";
    case EventCode::deflated:
      return "balloon empty";
    case EventCode::stent_deployed:
      return "stent in the wall";
    case EventCode::covered_stent:
      return "covered stent in the wall";
    default:
      return "";
  }
}

std::vector<Milestone> milestones_of(const ReportRun& run) {
  std::vector<Milestone> out;
  for (const RecordedEvent& event : events_of(run.record)) {
    const std::string what = words(event.code);
    if (!what.empty()) out.push_back({what.starts_with(" ") ? tool_of(run, event) + what : what, event.time_s});
  }
  return out;
}

/// Pairs of places of a longest common subsequence, by name.
std::vector<std::pair<std::size_t, std::size_t>> common(const std::vector<Stage>& a, const std::vector<Milestone>& b) {
  std::vector<std::vector<int>> longest(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;)
      longest[i][j] =
          a[i].name == b[j].name ? 1 + longest[i + 1][j + 1] : std::max(longest[i + 1][j], longest[i][j + 1]);
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].name == b[j].name)
      out.emplace_back(i++, j++);
    else if (longest[i + 1][j] >= longest[i][j + 1])
      ++i;
    else
      ++j;
  }
  return out;
}

}  // namespace

std::vector<Stage> common_stages(const std::vector<ReportRun>& runs) {
  std::vector<Stage> stages;
  for (const Milestone& milestone : milestones_of(runs.front())) stages.push_back({milestone.name, {milestone.at_s}});
  for (std::size_t r = 1; r < runs.size(); ++r) {
    const std::vector<Milestone> others = milestones_of(runs[r]);
    std::vector<Stage> kept;
    for (const auto& [i, j] : common(stages, others)) {
      kept.push_back(stages[i]);
      kept.back().begin_s.push_back(others[j].at_s);
    }
    stages = std::move(kept);
  }
  stages.insert(stages.begin(), {"the run begins", std::vector<double>(runs.size(), 0.0)});
  return stages;
}

}  // namespace ostium::data
