#include "data/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace ostium {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A signal's column; of tools: of each tool that has it.
struct Column {
  const RunRecord& record;
  std::size_t at;
  double operator[](std::size_t row) const { return record.signals[row * record.signal_columns.size() + at]; }
};

std::vector<Column> columns(const RunRecord& record, const std::string& ending) {
  std::vector<Column> out;
  for (std::size_t c = 0; c < record.signal_columns.size(); ++c)
    if (record.signal_columns[c].ends_with("." + ending)) out.push_back({record, c});
  return out;
}

double spacing_s(const RunRecord& r) {
  const std::size_t w = r.signal_columns.size();
  return r.rows() > 1 ? r.signals[w] - r.signals[0] : 0;
}

/// First-order low pass of 10 Hz, as forces are judged; the largest and the mean of the largest tool's.
struct Filtered {
  double largest = 0, mean = 0, above_limit = 0;
};
Filtered filtered(const RunRecord& r, const std::string& signal) {
  const double dt = spacing_s(r), share = 1 - std::exp(-2 * M_PI * wall_force_cut_off_Hz * dt);
  const std::vector<Column> forces = columns(r, signal);
  std::vector<double> low(forces.size(), 0);
  Filtered out;
  for (std::size_t i = 0; i < r.rows(); ++i) {
    double most = 0;
    for (std::size_t t = 0; t < forces.size(); ++t)
      low[t] += share * (forces[t][i] - low[t]), most = std::max(most, low[t]);
    out.largest = std::max(out.largest, most);
    out.mean += most / static_cast<double>(r.rows());
    out.above_limit += (most > wall_force_limit_N) / static_cast<double>(r.rows());
  }
  return out;
}

double time_of_first(const RunRecord& r, EventCode code, const std::vector<std::string>& branches) {
  for (std::size_t e = 0; e + 3 < r.events.size(); e += 4) {
    if (static_cast<int>(r.events[e + 1]) != static_cast<int>(code)) continue;
    const auto branch = static_cast<std::size_t>(r.events[e + 3]);
    if (branches.empty()) return r.events[e] * r.step_s;
    if (branch < r.branches.size() && std::count(branches.begin(), branches.end(), r.branches[branch]))
      return r.events[e] * r.step_s;
  }
  return none;
}

double count(const RunRecord& r, EventCode code) {
  double n = 0;
  for (std::size_t e = 0; e + 3 < r.events.size(); e += 4)
    n += static_cast<int>(r.events[e + 1]) == static_cast<int>(code);
  return n;
}

/// Between an event that switches on and one that switches off, to the end of the run.
double time_on(const RunRecord& r, EventCode on, EventCode off) {
  double sum = 0, since = -1;
  for (std::size_t e = 0; e + 3 < r.events.size(); e += 4) {
    const int code = static_cast<int>(r.events[e + 1]);
    if (code == static_cast<int>(on) && since < 0) since = r.events[e];
    if (code == static_cast<int>(off) && since >= 0) sum += r.events[e] - since, since = -1;
  }
  if (since >= 0) sum += static_cast<double>(r.steps) - since;
  return sum * r.step_s;
}

/// Along the vessel, of all tools; within a branch only, so that a beat that shifts a tip to the next adds nothing.
double tip_path_mm(const RunRecord& r) {
  double sum = 0;
  const std::vector<Column> along = columns(r, "tip_along_mm"), branch = columns(r, "tip_branch");
  for (std::size_t t = 0; t < along.size(); ++t) {
    // A change counts once it is larger than the spacing of the tree's spheres lets it tremble.
    double last = none;
    for (std::size_t i = 0; i < r.rows(); ++i) {
      if (branch[t][i] < 0) {
        last = none;
        continue;
      }
      if (std::isnan(last)) last = along[t][i];
      const double moved = std::fabs(along[t][i] - last);
      if (moved < 5) continue;
      sum += moved, last = along[t][i];
    }
  }
  return sum;
}

double hand_path_mm(const RunRecord& r) {
  double sum = 0;
  for (const Column& inserted : columns(r, "inserted_mm"))
    for (std::size_t i = 1; i < r.rows(); ++i) sum += std::fabs(inserted[i] - inserted[i - 1]);
  return sum;
}

double deepest_along_mm(const RunRecord& r) {
  double most = 0;
  for (const Column& along : columns(r, "tip_along_mm"))
    for (std::size_t i = 0; i < r.rows(); ++i) most = std::max(most, along[i]);
  return most;
}

double largest(const RunRecord& r, const std::string& signal) {
  double most = 0;
  for (const Column& column : columns(r, signal))
    for (std::size_t i = 0; i < r.rows(); ++i) most = std::max(most, std::fabs(column[i]));
  return most;
}

}  // namespace

const std::vector<EventDefinition>& event_definitions() {
  static const std::vector<EventDefinition> all = {
      {EventCode::script_step_begins, "script_step_begins", "the script's operator begins a step", "step, from 0"},
      {EventCode::script_step_done, "script_step_done", "one of its conditions holds", "step, from 0"},
      {EventCode::script_step_failed, "script_step_failed", "one of its `unless` holds", "step, from 0"},
      {EventCode::script_step_timed_out, "script_step_timed_out", "its time is over", "step, from 0"},
      {EventCode::mark, "mark", "the operator or trainer marks this moment", "step of the script, from 0"},
      {EventCode::tool_in, "tool_in", "a tool's tip leaves the introducer into the vessel", ""},
      {EventCode::tool_out, "tool_out", "a tool has been drawn out", ""},
      {EventCode::tip_enters, "tip_enters", "a tip comes into another branch of the tree", "branch, from 0"},
      {EventCode::wall_force_high, "wall_force_high",
       "the sum of wall forces on a tool, behind a low pass of 10 Hz, rises above 1 N; again only after it was below "
       "0.8 N",
       "N"},
      {EventCode::fluoroscopy_on, "fluoroscopy_on", "pedal down", ""},
      {EventCode::fluoroscopy_off, "fluoroscopy_off", "pedal up", ""},
      {EventCode::cine_on, "cine_on", "pedal down", ""},
      {EventCode::cine_off, "cine_off", "pedal up", ""},
      {EventCode::step_trouble, "step_trouble", "the engine had to give way in a step, after one in which it had not",
       "bits of core's Trouble"}};
  return all;
}

const std::vector<MetricDefinition>& metric_definitions() {
  static const std::vector<MetricDefinition> all = {
      {"procedure_time_s", "s", "simulated time from the first step to the last; pauses are no steps",
       [](const RunRecord& r) { return static_cast<double>(r.steps) * r.step_s; }},
      {"ascent_time_s", "s",
       "from the first tool in the body until a tip first comes into a sinus or a coronary artery",
       [](const RunRecord& r) {
         return time_of_first(r, EventCode::tip_enters,
                              {"left sinus", "right sinus", "non-coronary sinus", "LM", "RCA"}) -
                time_of_first(r, EventCode::tool_in, {});
       }},
      {"cannulation_time_s", "s", "from the first tool in the body until a tip first enters LM or RCA",
       [](const RunRecord& r) {
         return time_of_first(r, EventCode::tip_enters, {"LM", "RCA"}) - time_of_first(r, EventCode::tool_in, {});
       }},
      {"fluoroscopy_time_s", "s", "pedal down, cine apart",
       [](const RunRecord& r) { return time_on(r, EventCode::fluoroscopy_on, EventCode::fluoroscopy_off); }},
      {"cine_time_s", "s", "cine pedal down",
       [](const RunRecord& r) { return time_on(r, EventCode::cine_on, EventCode::cine_off); }},
      {"cine_runs", "1", "times that the cine pedal went down",
       [](const RunRecord& r) { return count(r, EventCode::cine_on); }},
      {"dap_Gy_cm2", "Gy cm2", "dose-area product of all frames, fluoroscopy and cine",
       [](const RunRecord& r) { return 1e4 * r.dose_area_Gy_m2; }},
      {"air_kerma_mGy", "mGy", "of all frames at the interventional reference point, 15 cm before the isocentre",
       [](const RunRecord& r) { return 1e3 * r.kerma_Gy; }},
      {"wall_force_max_N", "N",
       "largest, over tools, of the sum of the walls' normal forces on a tool, behind a low pass of 10 Hz",
       [](const RunRecord& r) { return filtered(r, "wall_force_N").largest; }},
      {"wall_force_mean_N", "N", "mean over the run of the same, of the tool that has most",
       [](const RunRecord& r) { return filtered(r, "wall_force_N").mean; }},
      {"wall_force_impulse_N_s", "N s", "the mean times the procedure's time",
       [](const RunRecord& r) { return filtered(r, "wall_force_N").mean * static_cast<double>(r.steps) * r.step_s; }},
      {"wall_force_above_limit_percent", "%", "share of the procedure's time above 1 N",
       [](const RunRecord& r) { return 100 * filtered(r, "wall_force_N").above_limit; }},
      {"tip_force_max_N", "N", "the same as wall_force_max_N, of the last 10 mm",
       [](const RunRecord& r) { return filtered(r, "tip_force_N").largest; }},
      {"push_max_N", "N", "largest push or pull at a hand, unfiltered",
       [](const RunRecord& r) { return largest(r, "push_N"); }},
      {"torque_max_mN_m", "mN m", "largest torque at a hand, unfiltered",
       [](const RunRecord& r) { return largest(r, "torque_mNm"); }},
      {"tip_path_length_mm", "mm", "sum over tools of the tip's way along the vessel's tree, in moves of at least 5 mm",
       tip_path_mm},
      {"hand_path_length_mm", "mm", "sum over tools of length fed and drawn back", hand_path_mm},
      {"tip_reached_mm", "mm", "farthest that a tip came along the tree from the access", deepest_along_mm},
      {"wall_force_high_count", "1", "events wall_force_high",
       [](const RunRecord& r) { return count(r, EventCode::wall_force_high); }},
      {"step_trouble_count", "1", "events step_trouble",
       [](const RunRecord& r) { return count(r, EventCode::step_trouble); }}};
  return all;
}

std::vector<Metric> metrics_of(const RunRecord& record) {
  std::vector<Metric> out;
  for (const MetricDefinition& d : metric_definitions()) out.push_back({d.name, d.of(record), d.unit});
  return out;
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

}  // namespace ostium
