/// The patient's answer, and how soon an emergency was met.
#include <algorithm>

#include "data/assessment/metric_functions.h"
#include "data/assessment/metrics.h"

namespace ostium::data {

namespace {

/// From the first event of a kind to the next one of another; endless if that never came, so that a limit is exceeded.
MetricFunction from_first_to(EventCode cause, EventCode answer) {
  return [=](const RunRecord& r) {
    const std::vector<RecordedEvent> causes = events_of(r, cause), answers = events_of(r, answer);
    if (causes.empty()) return does_not_apply;
    const auto after = std::find_if(answers.begin(), answers.end(),
                                    [&](const RecordedEvent& one) { return one.step >= causes.front().step; });
    return after == answers.end() ? never_s : after->time_s - causes.front().time_s;
  };
}

double to_shock_s(const RunRecord& r) {
  constexpr double fibrillation = 2;
  const std::vector<RecordedEvent> rhythms = events_of(r, EventCode::rhythm_changes),
                                   shocks = events_of(r, EventCode::shock);
  for (const RecordedEvent& one : rhythms) {
    if (one.value != fibrillation) continue;
    for (const RecordedEvent& shock : shocks)
      if (shock.step >= one.step) return shock.time_s - one.time_s;
    return never_s;
  }
  return does_not_apply;
}

/// When something was going on: from each `begins` to the next `ends`, or to the end of the run.
std::vector<std::pair<double, double>> spans(const RunRecord& r, EventCode begins, EventCode ends) {
  std::vector<std::pair<double, double>> out;
  bool on = false;
  for (const RecordedEvent& one : events_of(r)) {
    if (one.code == begins && !on) out.emplace_back(one.time_s, 0), on = true;
    if (one.code == ends && on) out.back().second = one.time_s, on = false;
  }
  if (on) out.back().second = r.step_s * static_cast<double>(r.steps);
  return out;
}

double pulseless_s(const RunRecord& r) {
  double sum = 0;
  for (const auto& [lost_s, back_s] : spans(r, EventCode::pulse_lost, EventCode::pulse_back)) sum += back_s - lost_s;
  return sum;
}

double compressed_share(const RunRecord& r) {
  double without = 0, both = 0;
  for (const auto& [lost_s, back_s] : spans(r, EventCode::pulse_lost, EventCode::pulse_back)) {
    without += back_s - lost_s;
    for (const auto& [from_s, to_s] : spans(r, EventCode::compressions_begin, EventCode::compressions_end))
      both += std::max(0.0, std::min(back_s, to_s) - std::max(lost_s, from_s));
  }
  return without > 0 ? both / without : does_not_apply;
}

double least_systolic(const RunRecord& r) {
  const std::vector<double> column = all_of(r, "systolic_mmHg");
  return column.empty() ? does_not_apply : *std::min_element(column.begin(), column.end());
}

}  // namespace

std::vector<MetricDefinition> patient_metrics() {
  using enum Better;
  return {
      {"systolic_least_mmHg", "mmHg", higher, "least systolic pressure of a beat in the aorta", least_systolic},
      {"pericardium_most_mL", "mL", lower, "most fluid round the heart", most("pericardium_mL")},
      {"pulseless_time_s", "s", lower, "without a pulse", pulseless_s},
      {"compressed_share", "1", higher, "of that, in which the chest was compressed; null: there was none",
       compressed_share},
      {"perforation_to_balloon_s", "s", lower,
       "from the first perforation until a balloon is inflated; null: there was none; 1e6: it never was",
       from_first_to(EventCode::perforation, EventCode::inflation_begins)},
      {"perforation_to_covered_stent_s", "s", lower, "the same, until a covered stent is left",
       from_first_to(EventCode::perforation, EventCode::covered_stent)},
      {"low_pressure_to_drain_s", "s", lower,
       "from the first systolic pressure below 80 mmHg until the pericardium is drained; null and 1e6 as above",
       from_first_to(EventCode::pressure_low, EventCode::drain_begins)},
      {"fibrillation_to_shock_s", "s", lower, "from the first fibrillation to a shock; null and 1e6 as above",
       to_shock_s},
  };
}

}  // namespace ostium::data
