#include "app/commands/sweep/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/formats/csv.h"

namespace ostium::app {

namespace {

std::string beginning_of(const SweepGrid& grid, std::size_t run) {
  const std::size_t setting = grid.setting_of(run);
  std::string line =
      fmt::format("{},{},{}", data::csv_field(grid.case_of(setting)), data::csv_field(grid.script), grid.seed_of(run));
  for (const std::string& value : grid.values_of(setting)) line += "," + data::csv_field(value);
  return line;
}

/// In one line, as a run's is.
std::string reason_of(std::string why) {
  std::replace_if(
      why.begin(), why.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return data::csv_field(why);
}

/// Commas outside quotes.
std::ptrdiff_t commas_in(const std::string& line) {
  std::ptrdiff_t count = 0;
  bool quoted = false;
  for (const char c : line) quoted ^= c == '"', count += c == ',' && !quoted;
  return count;
}

std::string end_without_result() { return ",0.000" + std::string(data::metric_definitions().size() + 4, ',') + "\n"; }

}  // namespace

std::string heading(const SweepGrid& grid) {
  std::string line = "case,script,seed";
  for (const std::string& key : grid.keys) line += "," + data::csv_field(key);
  line += ",outcome,reason,simulated_s";
  for (const data::MetricDefinition& metric : data::metric_definitions()) line += "," + metric.name;
  return line + ",deepest_penetration_mm,nodes_outside,troubled_steps,state\n";
}

std::string line_without_result(const SweepGrid& grid, std::size_t run, const std::string& why) {
  return beginning_of(grid, run) + ",aborted," + reason_of(why) + end_without_result();
}

bool is_line_of(const SweepGrid& grid, std::size_t run, const std::string& line) {
  return line.starts_with(beginning_of(grid, run) + ",") && commas_in(line) == commas_in(heading(grid));
}

bool has_no_result(const std::string& line) { return line.ends_with(end_without_result()); }

std::string without_end(const std::string& line) { return line.substr(0, line.size() - end_without_result().size()); }

std::string line_of(const SweepGrid& grid, std::size_t run, const ScriptedRun& scripted, const PlayReport& r) {
  std::string line = beginning_of(grid, run);
  line += fmt::format(",{},{},{:.3f}", r.outcome, reason_of(r.reason), r.simulated_s);
  for (const data::Metric& m : r.metrics) line += std::isfinite(m.value) ? fmt::format(",{:.9g}", m.value) : ",";
  return line + fmt::format(",{:.6f},{},{},{:016x}\n", 1e3 * r.penetration.deepest_m, r.penetration.outside,
                            scripted.troubled, r.hash);
}

}  // namespace ostium::app
