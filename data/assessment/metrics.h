#pragma once
/// Metrics of a run. A metric is a pure function of the recording's signals and events: one row in the table of
/// procedure_metrics.cpp or one of its kind, its function above it, and its number in
/// tests/data/assessment/metrics_test.cpp.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "data/assessment/run_record.h"

namespace ostium::data {

struct Metric {
  std::string name;
  double value = 0;  ///< NaN: does not apply
  std::string unit;
};

/// Of a time until something that never came: more than any limit.
inline constexpr double never_s = 1e6;
/// For people, from a minute on as the clock of the run writes it: "12.3 s", "6:52".
std::string duration_text(double seconds);
/// For people: "2.51 N", "6:52", "never"; "" if it does not apply.
std::string value_text(const Metric& metric);

/// Whether lower or higher is better, all else being equal. `neither`: descriptive, or the best lies in between.
enum class Better { lower, higher, neither };

struct MetricDefinition {
  std::string name;  ///< snake case, with the unit last
  std::string unit;
  Better better = Better::neither;
  std::string definition;  ///< says when the clock starts and stops
  std::function<double(const RunRecord&)> of;
};

std::vector<MetricDefinition> procedure_metrics();          ///< time, radiation, forces, paths, handling
std::vector<MetricDefinition> movement_metrics();           ///< how hands move, by part of the procedure
std::vector<MetricDefinition> patient_metrics();            ///< the patient's answer, and how soon it was met
std::vector<MetricDefinition> treatment_metrics();          ///< contrast, lesion, balloon, stent, flow, injury
const std::vector<MetricDefinition>& metric_definitions();  ///< all, in the order of metrics.json

/// All metrics, in the order of the table.
std::vector<Metric> metrics_of(const RunRecord& record);

/// metrics.json (data/schemas/metrics.schema.json).
std::string metrics_json(const std::string& case_name, std::uint64_t seed, const std::string& outcome,
                         const std::string& reason, const std::vector<Metric>& metrics);

}  // namespace ostium::data
