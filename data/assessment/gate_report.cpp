#include "data/assessment/gate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ostium::data {

bool GateResult::pass() const { return std::fabs(value - reference) <= tolerance; }

bool all_pass(const std::vector<GateResult>& results) {
  return std::all_of(results.begin(), results.end(), [](const GateResult& r) { return r.pass(); });
}

std::string to_json(const std::vector<GateResult>& results) {
  auto array = nlohmann::ordered_json::array();
  for (const GateResult& r : results)
    array.push_back({{"gate", r.gate},
                     {"value", r.value},
                     {"reference", r.reference},
                     {"tolerance", r.tolerance},
                     {"unit", r.unit},
                     {"pass", r.pass()}});
  return array.dump(2);
}

std::string names_to_json(const std::vector<std::pair<std::string, std::string>>& gates) {
  auto array = nlohmann::ordered_json::array();
  for (const auto& [name, what] : gates) array.push_back({{"gate", name}, {"what", what}});
  return array.dump(2);
}

std::string table_heading() {
  return fmt::format("{:<36} {:>14} {:>14} {:>12} {:<6} {}", "gate", "value", "reference", "tolerance", "unit", "");
}

std::string table_line(const GateResult& r) {
  return fmt::format("{:<36} {:>14.7g} {:>14.7g} {:>12.3g} {:<6} {}", r.gate, r.value, r.reference, r.tolerance, r.unit,
                     r.pass() ? "pass" : "FAIL");
}

}  // namespace ostium::data
