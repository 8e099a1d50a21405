/// Time, radiation, forces, paths and handling.
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/assessment/metric_functions.h"
#include "data/assessment/metrics.h"

namespace ostium::data {

namespace {

double procedure_time_s(const RunRecord& r) { return static_cast<double>(r.steps) * r.step_s; }

double time_of_first(const RunRecord& r, EventCode code) {
  const std::vector<RecordedEvent> events = events_of(r, code);
  return events.empty() ? does_not_apply : events.front().time_s;
}

/// From the first tool in the body until the event first comes.
MetricFunction time_until(EventCode code) {
  return [code](const RunRecord& r) { return time_of_first(r, code) - time_of_first(r, EventCode::tool_in); };
}

/// From the first tool in the body until a tip first comes into one of these branches.
MetricFunction time_until_tip_enters(const std::vector<std::string>& branches) {
  return [branches](const RunRecord& r) {
    for (const RecordedEvent& e : events_of(r, EventCode::tip_enters)) {
      const auto branch = static_cast<std::size_t>(e.value);
      if (branch < r.branches.size() && std::count(branches.begin(), branches.end(), r.branches[branch]))
        return e.time_s - time_of_first(r, EventCode::tool_in);
    }
    return does_not_apply;
  };
}

/// Total time between `on` events and the `off` events that follow, or the end of the run.
MetricFunction time_on(EventCode on, EventCode off) {
  return [=](const RunRecord& r) {
    double steps = 0, since = -1;
    for (const RecordedEvent& e : events_of(r)) {
      if (e.code == on && since < 0) since = e.step;
      if (e.code == off && since >= 0) steps += e.step - since, since = -1;
    }
    if (since >= 0) steps += static_cast<double>(r.steps) - since;
    return steps * r.step_s;
  };
}

/// The beam of the fluoroscopy pedal: while both are down, the cine pedal's is on.
double fluoroscopy_time_s(const RunRecord& r) {
  using enum EventCode;
  double steps = 0, since = 0;
  bool fluoroscopy = false, cine = false;
  const auto count_to = [&](double step) {
    if (fluoroscopy && !cine) steps += step - since;
    since = step;
  };
  for (const RecordedEvent& e : events_of(r)) {
    count_to(e.step);
    fluoroscopy = e.code == fluoroscopy_on || (fluoroscopy && e.code != fluoroscopy_off);
    cine = e.code == cine_on || (cine && e.code != cine_off);
  }
  count_to(static_cast<double>(r.steps));
  return steps * r.step_s;
}

/// Number of errors of at least that severity.
MetricFunction errors_of(Severity least) {
  return [least](const RunRecord& r) {
    double n = 0;
    for (const RecordedEvent& e : events_of(r))
      if (const EventDefinition* d = definition_of(e.code)) n += d->severity >= least;
    return n;
  };
}

/// A force of the tools after the low pass (wall_force_cut_off_Hz).
struct FilteredForce {
  double largest_N = 0, mean_N = 0;  ///< largest over the tools
  double above_limit = 0;            ///< share of the time above wall_force_limit_N
};
/// `less`: a signal to subtract from the force; empty: none.
FilteredForce filtered(const RunRecord& r, const std::string& force, const std::string& less = "") {
  const double share = 1 - std::exp(-2 * units::pi * wall_force_cut_off_Hz * row_spacing_s(r));
  const std::vector<SignalColumn> forces = tool_columns(r, force), taken = tool_columns(r, less);
  std::vector<double> low(forces.size(), 0);
  FilteredForce out;
  for (std::size_t i = 0; i < r.rows(); ++i) {
    double most = 0;
    for (std::size_t t = 0; t < forces.size(); ++t)
      low[t] += share * (forces[t][i] - (less.empty() ? 0 : taken[t][i]) - low[t]), most = std::max(most, low[t]);
    out.largest_N = std::max(out.largest_N, most);
    out.mean_N += most / static_cast<double>(r.rows());
    out.above_limit += (most > wall_force_limit_N) / static_cast<double>(r.rows());
  }
  return out;
}

/// Largest magnitude over tools and the run.
MetricFunction largest(const std::string& signal) {
  return [signal](const RunRecord& r) {
    double most = 0;
    for (const SignalColumn& column : tool_columns(r, signal))
      for (std::size_t i = 0; i < r.rows(); ++i) most = std::max(most, std::fabs(column[i]));
    return most;
  };
}

/// Tip travel along the vessel, summed over tools. Counted within a branch only, so that a heartbeat that moves a tip
/// into the next branch adds nothing.
double tip_path_mm(const RunRecord& r) {
  // Smaller moves may only be the spacing of the tree's spheres.
  constexpr double least_move_mm = 5;
  double sum = 0;
  const std::vector<SignalColumn> along = tool_columns(r, "tip_along_mm"), branch = tool_columns(r, "tip_branch");
  for (std::size_t t = 0; t < along.size(); ++t) {
    double last = does_not_apply;
    for (std::size_t i = 0; i < r.rows(); ++i) {
      if (branch[t][i] < 0) {
        last = does_not_apply;
        continue;
      }
      if (std::isnan(last)) last = along[t][i];
      const double moved = std::fabs(along[t][i] - last);
      if (moved < least_move_mm) continue;
      sum += moved, last = along[t][i];
    }
  }
  return sum;
}

double hand_path_mm(const RunRecord& r) {
  double sum = 0;
  for (const SignalColumn& inserted : tool_columns(r, "inserted_mm"))
    for (std::size_t i = 1; i < r.rows(); ++i) sum += std::fabs(inserted[i] - inserted[i - 1]);
  return sum;
}

double path_ratio(const RunRecord& r) {
  double went = 0, needed = 0;
  for (const SignalColumn& inserted : tool_columns(r, "inserted_mm")) {
    if (r.rows() == 0) break;
    double most = inserted[0];
    for (std::size_t i = 1; i < r.rows(); ++i)
      went += std::fabs(inserted[i] - inserted[i - 1]), most = std::max(most, inserted[i]);
    needed += 2 * most - inserted[0] - inserted[r.rows() - 1];
  }
  return needed > 0 ? went / needed : does_not_apply;
}

/// For each row: whether the fluoroscopy or cine pedal is down.
std::vector<bool> beam_is_on(const RunRecord& r) {
  const std::vector<RecordedEvent> events = events_of(r);
  std::vector<bool> out;
  bool fluoroscopy = false, cine = false;
  auto e = events.begin();
  for (std::size_t i = 0; i < r.rows(); ++i) {
    for (; e != events.end() && e->time_s <= SignalColumn{r, 0}[i] + 1e-9; ++e) {
      if (e->code == EventCode::fluoroscopy_on || e->code == EventCode::fluoroscopy_off)
        fluoroscopy = e->code == EventCode::fluoroscopy_on;
      if (e->code == EventCode::cine_on || e->code == EventCode::cine_off) cine = e->code == EventCode::cine_on;
    }
    out.push_back(fluoroscopy || cine);
  }
  return out;
}

double blind_path_mm(const RunRecord& r) {
  const std::vector<bool> on = beam_is_on(r);
  double sum = 0;
  for (const SignalColumn& inserted : tool_columns(r, "inserted_mm"))
    for (std::size_t i = 1; i < r.rows(); ++i) sum += on[i] ? 0 : std::fabs(inserted[i] - inserted[i - 1]);
  return sum;
}

double idle_beam_s(const RunRecord& r) {
  const std::vector<bool> on = beam_is_on(r);
  const std::vector<double> contrast = all_of(r, "contrast_mL"), balloon = all_of(r, "balloon_atm");
  const std::vector<SignalColumn> inserted = tool_columns(r, "inserted_mm"), turned = tool_columns(r, "turned_deg");
  double sum = 0;
  for (std::size_t i = 1; i < r.rows(); ++i) {
    bool busy = (!contrast.empty() && contrast[i] != contrast[i - 1]) || (!balloon.empty() && balloon[i] > 1);
    for (const SignalColumn& c : inserted) busy = busy || c[i] != c[i - 1];
    for (const SignalColumn& c : turned) busy = busy || c[i] != c[i - 1];
    sum += on[i] && !busy ? row_spacing_s(r) : 0;
  }
  return sum;
}

double hints_asked(const RunRecord& r) {
  const auto asked = events_of(r, EventCode::hint_asked).size();
  return asked == 0 && events_of(r, EventCode::instruction_done).empty() ? does_not_apply : static_cast<double>(asked);
}

double tip_reached_mm(const RunRecord& r) {
  double most = 0;
  for (const SignalColumn& along : tool_columns(r, "tip_along_mm"))
    for (std::size_t i = 0; i < r.rows(); ++i) most = std::max(most, along[i]);
  return most;
}

/// Of the tool that came least far.
double all_tips_reached_mm(const RunRecord& r) {
  double least = does_not_apply;
  for (const SignalColumn& along : tool_columns(r, "tip_along_mm")) {
    double most = 0;
    for (std::size_t i = 0; i < r.rows(); ++i) most = std::max(most, along[i]);
    least = std::fmin(least, most);
  }
  return least;
}

}  // namespace

std::vector<MetricDefinition> procedure_metrics() {
  using enum Better;
  using enum EventCode;
  return {
      {"procedure_time_s", "s", lower, "simulated time from the first step to the last; pauses are no steps",
       procedure_time_s},
      {"ascent_time_s", "s", lower,
       "from the first tool in the body until a tip has first been in a sinus or a coronary artery for 0.3 s",
       time_until_tip_enters({"left sinus", "right sinus", "non-coronary sinus", "LM", "LAD", "LCx", "RCA"})},
      {"cannulation_time_s", "s", lower,
       "from the first tool in the body until a tip has first been in LM, LAD, LCx or RCA for 0.3 s",
       time_until_tip_enters({"LM", "LAD", "LCx", "RCA"})},
      {"first_inflation_after_s", "s", lower, "from the first tool in the body until the gauge first rises above 1 atm",
       time_until(inflation_begins)},
      {"stent_after_s", "s", lower, "from the first tool in the body until a stent is left in a lesion's artery",
       time_until(stent_deployed)},
      {"fluoroscopy_time_s", "s", lower, "pedal down, cine apart", fluoroscopy_time_s},
      {"cine_time_s", "s", lower, "cine pedal down", time_on(cine_on, cine_off)},
      {"cine_runs", "1", lower, "times that the cine pedal went down", count_of(cine_on)},
      {"idle_beam_time_s", "s", lower,
       "beam on, fluoroscopy or cine, while no tool is moved, nothing injected and no balloon above 1 atm",
       idle_beam_s},
      {"dap_Gy_cm2", "Gy cm2", lower, "dose-area product of all frames, fluoroscopy and cine",
       [](const RunRecord& r) { return 1e4 * r.dose_area_Gy_m2; }},
      {"air_kerma_mGy", "mGy", lower, "of all frames at the interventional reference point, 15 cm before the isocentre",
       [](const RunRecord& r) { return 1e3 * r.kerma_Gy; }},
      {"wall_force_max_N", "N", lower,
       "largest, over tools, of the sum of the walls' normal forces on a tool, behind a low pass of 10 Hz",
       [](const RunRecord& r) { return filtered(r, "wall_force_N").largest_N; }},
      {"wall_force_mean_N", "N", lower, "mean over the run of the same, of the tool that has most",
       [](const RunRecord& r) { return filtered(r, "wall_force_N").mean_N; }},
      {"wall_force_impulse_N_s", "N s", lower, "the mean times the procedure's time",
       [](const RunRecord& r) { return filtered(r, "wall_force_N").mean_N * static_cast<double>(r.steps) * r.step_s; }},
      {"wall_force_above_limit_percent", "%", lower, "share of the procedure's time above 1 N",
       [](const RunRecord& r) { return 100 * filtered(r, "wall_force_N").above_limit; }},
      {"tip_force_max_N", "N", lower, "the same as wall_force_max_N, of the last 10 mm",
       [](const RunRecord& r) { return filtered(r, "tip_force_N").largest_N; }},
      {"shaft_force_max_N", "N", lower, "the same as wall_force_max_N, without the last 10 mm",
       [](const RunRecord& r) { return filtered(r, "wall_force_N", "tip_force_N").largest_N; }},
      {"push_max_N", "N", lower, "largest push or pull at a hand, unfiltered", largest("push_N")},
      {"torque_max_mN_m", "mN m", lower, "largest torque at a hand, unfiltered", largest("torque_mNm")},
      {"tip_path_length_mm", "mm", lower,
       "sum over tools of the tip's way along the vessel's tree, in moves of at least 5 mm", tip_path_mm},
      {"hand_path_length_mm", "mm", lower, "sum over tools of length fed and drawn back", hand_path_mm},
      {"path_ratio", "1", lower,
       "hand path over the shortest that does the same: each tool to its deepest and back to where it ends",
       path_ratio},
      {"blind_path_length_mm", "mm", lower, "of the hand path, with the beam off", blind_path_mm},
      {"tip_reached_mm", "mm", neither, "farthest that a tip came along the tree from the access", tip_reached_mm},
      {"all_tips_reached_mm", "mm", neither, "the same, of the tool that came least far", all_tips_reached_mm},
      {"handling_errors", "1", lower, "events that are errors of handling, critical ones among them",
       errors_of(Severity::error)},
      {"handling_errors_critical", "1", lower, "those that are critical", errors_of(Severity::critical)},
      {"wall_force_high_count", "1", lower, "events wall_force_high", count_of(wall_force_high)},
      {"hints_asked", "1", lower, "how often a learner asked how the expert does it; in lessons", hints_asked},
      {"step_trouble_count", "1", lower, "events step_trouble", count_of(step_trouble)},
  };
}

}  // namespace ostium::data
