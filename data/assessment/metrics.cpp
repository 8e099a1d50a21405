#include "data/assessment/metrics.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace ostium::data {

const std::vector<MetricDefinition>& metric_definitions() {
  static const std::vector<MetricDefinition> all = [] {
    std::vector<MetricDefinition> out = procedure_metrics();
    for (MetricDefinition& d : movement_metrics()) out.push_back(std::move(d));
    for (MetricDefinition& d : treatment_metrics()) out.push_back(std::move(d));
    for (MetricDefinition& d : patient_metrics()) out.push_back(std::move(d));
    return out;
  }();
  return all;
}

std::vector<Metric> metrics_of(const RunRecord& record) {
  std::vector<Metric> out;
  for (const MetricDefinition& d : metric_definitions()) out.push_back({d.name, d.of(record), d.unit});
  return out;
}

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.3g} s", seconds);
  const auto whole = static_cast<long>(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string value_text(const Metric& metric) {
  if (!std::isfinite(metric.value)) return "";
  if (metric.unit == "s") return metric.value >= never_s ? "never" : duration_text(metric.value);
  return fmt::format("{:.4g}{}", metric.value, metric.unit == "1" ? "" : " " + metric.unit);
}

std::string metrics_json(const std::string& case_name, std::uint64_t seed, const std::string& outcome,
                         const std::string& reason, const std::vector<Metric>& metrics) {
  nlohmann::ordered_json out = {{"case", case_name}, {"seed", seed}, {"outcome", outcome}, {"reason", reason}};
  out["metrics"] = nlohmann::ordered_json::array();
  for (const Metric& m : metrics)
    out["metrics"].push_back(
        {{"name", m.name},
         {"value", std::isfinite(m.value) ? nlohmann::ordered_json(m.value) : nlohmann::ordered_json()},
         {"unit", m.unit}});
  return out.dump(2) + "\n";
}

}  // namespace ostium::data
