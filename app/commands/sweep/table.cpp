#include "app/commands/sweep/table.h"

#include <fmt/format.h>

#include <cmath>

#include "data/formats/csv.h"

namespace ostium::app {

namespace {

std::string beginning_of(const SweepTask& task) {
  std::string line =
      fmt::format("{},{},{}", data::csv_field(task.setup.vessel), data::csv_field(task.setup.script.name), task.seed);
  for (const std::string& value : task.values) line += "," + data::csv_field(value);
  return line;
}

}  // namespace

std::string heading(const Sweep& sweep) {
  std::string line = "case,script,seed";
  for (const std::string& key : sweep.keys) line += "," + data::csv_field(key);
  line += ",outcome,reason,simulated_s";
  for (const data::MetricDefinition& metric : data::metric_definitions()) line += "," + metric.name;
  return line + ",deepest_penetration_mm,nodes_outside,troubled_steps,state\n";
}

std::string line_without_vessel(const SweepTask& task, const std::string& why) {
  return beginning_of(task) + ",aborted," + data::csv_field(why) + ",0.000" +
         std::string(data::metric_definitions().size() + 4, ',') + "\n";
}

std::string line_of(const SweepTask& task, const ScriptedRun& run, const PlayReport& r) {
  std::string line = beginning_of(task);
  line += fmt::format(",{},{},{:.3f}", r.outcome, data::csv_field(r.reason), r.simulated_s);
  for (const data::Metric& m : r.metrics) line += std::isfinite(m.value) ? fmt::format(",{:.9g}", m.value) : ",";
  return line + fmt::format(",{:.6f},{},{},{:016x}\n", 1e3 * r.penetration.deepest_m, r.penetration.outside,
                            run.troubled, r.hash);
}

}  // namespace ostium::app
