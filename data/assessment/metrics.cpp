#include "data/assessment/metrics.h"

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

/// First-order low pass of 10 Hz, as forces are judged, of one signal, or of what it is beyond another; the largest and
/// the mean of the largest tool's.
struct Filtered {
  double largest = 0, mean = 0, above_limit = 0;
};
Filtered filtered(const RunRecord& r, const std::string& signal, const std::string& less = "") {
  const double dt = spacing_s(r), share = 1 - std::exp(-2 * M_PI * wall_force_cut_off_Hz * dt);
  const std::vector<Column> forces = columns(r, signal), taken = columns(r, less);
  std::vector<double> low(forces.size(), 0);
  Filtered out;
  for (std::size_t i = 0; i < r.rows(); ++i) {
    double most = 0;
    for (std::size_t t = 0; t < forces.size(); ++t)
      low[t] += share * (forces[t][i] - (less.empty() ? 0 : taken[t][i]) - low[t]), most = std::max(most, low[t]);
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

/// Events of at least that severity.
double count(const RunRecord& r, Severity least) {
  double n = 0;
  for (const EventDefinition& d : event_definitions())
    if (d.severity >= least) n += count(r, d.code);
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

/// What of the way hands went was not needed: over the shortest way in to the deepest place and back to the last.
double path_ratio(const RunRecord& r) {
  double went = 0, needed = 0;
  for (const Column& inserted : columns(r, "inserted_mm")) {
    if (r.rows() == 0) break;
    double most = inserted[0];
    for (std::size_t i = 1; i < r.rows(); ++i)
      went += std::fabs(inserted[i] - inserted[i - 1]), most = std::max(most, inserted[i]);
    needed += 2 * most - inserted[0] - inserted[r.rows() - 1];
  }
  return needed > 0 ? went / needed : none;
}

/// For each row: whether the fluoroscopy or cine pedal is down.
std::vector<bool> beam(const RunRecord& r) {
  std::vector<bool> out;
  const Column time{r, 0};
  bool fluoroscopy = false, cine = false;
  std::size_t e = 0;
  for (std::size_t i = 0; i < r.rows(); ++i) {
    for (; e + 3 < r.events.size() && r.events[e] * r.step_s <= time[i] + 1e-9; e += 4) {
      const auto code = static_cast<EventCode>(static_cast<int>(r.events[e + 1]));
      if (code == EventCode::fluoroscopy_on || code == EventCode::fluoroscopy_off)
        fluoroscopy = code == EventCode::fluoroscopy_on;
      if (code == EventCode::cine_on || code == EventCode::cine_off) cine = code == EventCode::cine_on;
    }
    out.push_back(fluoroscopy || cine);
  }
  return out;
}

double blind_path_mm(const RunRecord& r) {
  const std::vector<bool> on = beam(r);
  double sum = 0;
  for (const Column& inserted : columns(r, "inserted_mm"))
    for (std::size_t i = 1; i < r.rows(); ++i) sum += on[i] ? 0 : std::fabs(inserted[i] - inserted[i - 1]);
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

// --- of a case: columns that are not a tool's

double number_at(const RunRecord& r, const std::string& name, std::size_t row) {
  for (std::size_t c = 0; c < r.signal_columns.size(); ++c)
    if (r.signal_columns[c] == name && row < r.rows()) return r.signals[row * r.signal_columns.size() + c];
  return none;
}
double last_of(const RunRecord& r, const std::string& name) {
  return r.rows() ? number_at(r, name, r.rows() - 1) : none;
}

/// All rows of a column; empty if there is none of that name.
std::vector<double> all_of(const RunRecord& r, const std::string& name) {
  std::vector<double> out;
  for (std::size_t c = 0; c < r.signal_columns.size(); ++c)
    if (r.signal_columns[c] == name)
      for (std::size_t i = 0; i < r.rows(); ++i) out.push_back(r.signals[i * r.signal_columns.size() + c]);
  return out;
}

/// Time for which a column's value is in [least, most).
double time_within(const RunRecord& r, const std::string& name, double least, double most) {
  const std::vector<double> column = all_of(r, name);
  if (column.empty()) return none;
  double sum = 0;
  for (double x : column) sum += x >= least && x < most ? spacing_s(r) : 0;
  return sum;
}

double most_of(const RunRecord& r, const std::string& name) {
  const std::vector<double> column = all_of(r, name);
  return column.empty() ? none : std::max(0.0, *std::max_element(column.begin(), column.end(), [](double a, double b) {
                                            return (std::isnan(a) ? -1e300 : a) < (std::isnan(b) ? -1e300 : b);
                                          }));
}

double residual_percent(const RunRecord& r, const std::string& mld) {
  return 100 * (1 - last_of(r, mld) / last_of(r, "lesion_reference_mm"));
}

double coverage_percent(const RunRecord& r) {
  const double from = last_of(r, "stent_from_mm"), to = last_of(r, "stent_to_mm"),
               length = last_of(r, "lesion_length_mm");
  if (std::isnan(length)) return none;
  return std::isnan(from) ? 0 : 100 * std::max(0.0, std::min(to, length) - std::max(from, 0.0)) / length;
}

/// Length of what was ill or pressed by a balloon above 1 atm, and no stent covers.
double geographic_miss_mm(const RunRecord& r) {
  const double length = last_of(r, "lesion_length_mm"), s_from = last_of(r, "stent_from_mm"),
               s_to = last_of(r, "stent_to_mm");
  if (std::isnan(length) || std::isnan(s_from)) return none;
  std::vector<std::pair<double, double>> spans = {{0, length}};
  const std::vector<double> from = all_of(r, "balloon_from_mm"), to = all_of(r, "balloon_to_mm"),
                            pressure = all_of(r, "balloon_atm");
  for (std::size_t i = 0; i < from.size(); ++i)
    if (pressure[i] > 1 && !std::isnan(from[i])) spans.emplace_back(from[i], to[i]);
  std::sort(spans.begin(), spans.end());
  double missed = 0, reached = -1e300;
  for (auto [a, b] : spans) {
    a = std::max(a, reached), reached = std::max(reached, b);
    if (b <= a) continue;
    missed += b - a - std::max(0.0, std::min(b, s_to) - std::max(a, s_from));
  }
  return missed;
}

/// Nobody moves or turns a tool, injects, or has a balloon under pressure.
double idle_beam_s(const RunRecord& r) {
  const std::vector<bool> on = beam(r);
  const std::vector<double> contrast = all_of(r, "contrast_mL"), balloon = all_of(r, "balloon_atm");
  const std::vector<Column> inserted = columns(r, "inserted_mm"), turned = columns(r, "turned_deg");
  double sum = 0;
  for (std::size_t i = 1; i < r.rows(); ++i) {
    bool busy = (!contrast.empty() && contrast[i] != contrast[i - 1]) || (!balloon.empty() && balloon[i] > 1);
    for (const Column& c : inserted) busy = busy || c[i] != c[i - 1];
    for (const Column& c : turned) busy = busy || c[i] != c[i - 1];
    sum += on[i] && !busy ? spacing_s(r) : 0;
  }
  return sum;
}

/// As on films: the balloon's diameter at the last inflation's highest pressure against the lumen at the end.
double acute_recoil_percent(const RunRecord& r) {
  const std::vector<double> pressure = all_of(r, "balloon_atm"), width = all_of(r, "balloon_mm");
  double highest = 1, widest = none;
  for (std::size_t i = 0; i < width.size() && i < pressure.size(); ++i) {
    if (pressure[i] <= 1) highest = 1;
    if (pressure[i] > highest) highest = pressure[i], widest = width[i];
  }
  return 100 * (1 - last_of(r, "lesion_mld_mm") / widest);
}

/// Value of the first or the last event of a kind.
double event_value(const RunRecord& r, EventCode code, bool last) {
  double value = none;
  for (std::size_t e = 0; e + 3 < r.events.size(); e += 4) {
    if (static_cast<int>(r.events[e + 1]) != static_cast<int>(code)) continue;
    value = r.events[e + 3];
    if (!last) break;
  }
  return value;
}

/// TIMI frames of each injection that filled the ostium; not a number: contrast did not come to the landmark.
std::vector<double> timi_frames(const RunRecord& r) {
  constexpr double per_s = 30, given_up_s = 10;
  const std::vector<double> time = all_of(r, "time_s"), ostium = all_of(r, "contrast_ostium"),
                            landmark = all_of(r, "contrast_landmark");
  std::vector<double> out;
  if (ostium.empty() || landmark.empty()) return out;
  const auto crossing = [&](const std::vector<double>& of, std::size_t i, double level) {
    return i == 0 ? time[0]
                  : time[i - 1] + (time[i] - time[i - 1]) * (level - of[i - 1]) / std::max(of[i] - of[i - 1], 1e-9);
  };
  for (std::size_t i = 0; i < time.size(); ++i) {
    const bool fills = ostium[i] > filled_share && (i == 0 || ostium[i - 1] <= filled_share);
    // What is there from before hides what comes.
    if (!fills || landmark[i] > seen_share) continue;
    const double begun = crossing(ostium, i, filled_share);
    std::size_t k = i;
    while (k < time.size() && landmark[k] <= seen_share && time[k] - begun < given_up_s) ++k;
    const bool reached = k < time.size() && landmark[k] > seen_share;
    // A puff that is thinned on its way says nothing: it must run for half a second.
    std::size_t full = i;
    while (full < time.size() && ostium[full] > filled_share) ++full;
    if (!reached && (full == time.size() ? time.back() : time[full]) - begun < 0.5) continue;
    out.push_back(reached ? per_s * (crossing(landmark, k, seen_share) - begun) : none);
  }
  return out;
}

}  // namespace

const std::vector<MetricDefinition>& metric_definitions() {
  static const std::vector<MetricDefinition> all = {
      {"procedure_time_s", "s", "simulated time from the first step to the last; pauses are no steps",
       [](const RunRecord& r) { return static_cast<double>(r.steps) * r.step_s; }},
      {"ascent_time_s", "s",
       "from the first tool in the body until a tip has first been in a sinus or a coronary artery for 0.3 s",
       [](const RunRecord& r) {
         return time_of_first(r, EventCode::tip_enters,
                              {"left sinus", "right sinus", "non-coronary sinus", "LM", "LAD", "LCx", "RCA"}) -
                time_of_first(r, EventCode::tool_in, {});
       }},
      {"cannulation_time_s", "s",
       "from the first tool in the body until a tip has first been in LM, LAD, LCx or RCA for 0.3 s",
       [](const RunRecord& r) {
         return time_of_first(r, EventCode::tip_enters, {"LM", "LAD", "LCx", "RCA"}) -
                time_of_first(r, EventCode::tool_in, {});
       }},
      {"first_inflation_after_s", "s", "from the first tool in the body until the gauge first rises above 1 atm",
       [](const RunRecord& r) {
         return time_of_first(r, EventCode::inflation_begins, {}) - time_of_first(r, EventCode::tool_in, {});
       }},
      {"stent_after_s", "s", "from the first tool in the body until a stent is left in the first lesion's artery",
       [](const RunRecord& r) {
         return time_of_first(r, EventCode::stent_deployed, {}) - time_of_first(r, EventCode::tool_in, {});
       }},
      {"fluoroscopy_time_s", "s", "pedal down, cine apart",
       [](const RunRecord& r) { return time_on(r, EventCode::fluoroscopy_on, EventCode::fluoroscopy_off); }},
      {"cine_time_s", "s", "cine pedal down",
       [](const RunRecord& r) { return time_on(r, EventCode::cine_on, EventCode::cine_off); }},
      {"cine_runs", "1", "times that the cine pedal went down",
       [](const RunRecord& r) { return count(r, EventCode::cine_on); }},
      {"idle_beam_time_s", "s",
       "beam on, fluoroscopy or cine, while no tool is moved, nothing injected and no balloon above 1 atm",
       idle_beam_s},
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
      {"shaft_force_max_N", "N", "the same as wall_force_max_N, without the last 10 mm",
       [](const RunRecord& r) { return filtered(r, "wall_force_N", "tip_force_N").largest; }},
      {"push_max_N", "N", "largest push or pull at a hand, unfiltered",
       [](const RunRecord& r) { return largest(r, "push_N"); }},
      {"torque_max_mN_m", "mN m", "largest torque at a hand, unfiltered",
       [](const RunRecord& r) { return largest(r, "torque_mNm"); }},
      {"tip_path_length_mm", "mm", "sum over tools of the tip's way along the vessel's tree, in moves of at least 5 mm",
       tip_path_mm},
      {"hand_path_length_mm", "mm", "sum over tools of length fed and drawn back", hand_path_mm},
      {"path_ratio", "1",
       "hand path over the shortest that does the same: each tool to its deepest and back to where it ends",
       path_ratio},
      {"blind_path_length_mm", "mm", "of the hand path, with the beam off", blind_path_mm},
      {"tip_reached_mm", "mm", "farthest that a tip came along the tree from the access", deepest_along_mm},
      {"handling_errors", "1", "events that are errors of handling, critical ones among them",
       [](const RunRecord& r) { return count(r, Severity::error); }},
      {"handling_errors_critical", "1", "those that are critical",
       [](const RunRecord& r) { return count(r, Severity::critical); }},
      {"wall_force_high_count", "1", "events wall_force_high",
       [](const RunRecord& r) { return count(r, EventCode::wall_force_high); }},
      {"step_trouble_count", "1", "events step_trouble",
       [](const RunRecord& r) { return count(r, EventCode::step_trouble); }},
      {"contrast_volume_mL", "mL", "out of the syringe, as undiluted contrast of 350 mg of iodine per mL",
       [](const RunRecord& r) { return last_of(r, "contrast_mL"); }},
      {"iodine_g", "g", "that left the catheter", [](const RunRecord& r) { return last_of(r, "iodine_g"); }},
      {"residual_stenosis_percent", "%",
       "of the first lesion at the end: 1 - smallest diameter within it over the reference, the healthy artery's mean "
       "of 5 mm ahead of it and behind it",
       [](const RunRecord& r) { return residual_percent(r, "lesion_mld_mm"); }},
      {"residual_stenosis_in_segment_percent", "%", "the same with 5 mm on both sides of lesion and stents",
       [](const RunRecord& r) { return residual_percent(r, "segment_mld_mm"); }},
      {"residual_stenosis_worst_percent", "%", "of the case's lesions, that of which most is left",
       [](const RunRecord& r) { return last_of(r, "stenosis_worst_percent"); }},
      {"acute_gain_mm", "mm", "smallest diameter within the lesion at the end less that at the beginning",
       [](const RunRecord& r) { return last_of(r, "lesion_mld_mm") - number_at(r, "lesion_mld_mm", 0); }},
      {"acute_recoil_percent", "%",
       "1 - smallest diameter within the first lesion at the end over the balloon's, at the last inflation's highest "
       "pressure",
       acute_recoil_percent},
      {"balloon_artery_ratio", "1",
       "largest, over inflations, of the balloon's diameter between its markers over the healthy artery's there",
       [](const RunRecord& r) { return most_of(r, "balloon_ratio"); }},
      {"balloon_pressure_max_atm", "atm", "largest pressure in a balloon",
       [](const RunRecord& r) { return most_of(r, "balloon_atm"); }},
      {"inflations", "1", "times that the gauge rose above 1 atm",
       [](const RunRecord& r) { return count(r, EventCode::inflation_begins); }},
      {"stent_margin_proximal_mm", "mm",
       "from the proximal end of the stents at the first lesion to its own, negative: inside the lesion; of several "
       "stents, the one that covers most of it and those that are joined to it without a gap",
       [](const RunRecord& r) { return -last_of(r, "stent_from_mm"); }},
      {"stent_margin_distal_mm", "mm", "from the lesion's distal end to theirs, negative: inside the lesion",
       [](const RunRecord& r) { return last_of(r, "stent_to_mm") - last_of(r, "lesion_length_mm"); }},
      {"stent_margin_least_mm", "mm",
       "least of these margins at both ends of all of the case's lesions; null: the artery of one has no stent",
       [](const RunRecord& r) { return last_of(r, "stent_margin_least_mm"); }},
      {"lesion_coverage_percent", "%", "share of the first lesion's length that these stents lie in at the end",
       coverage_percent},
      {"geographic_miss_mm", "mm",
       "length of the union of the first lesion and of all inflations above 1 atm nearer to it than to another lesion "
       "that these stents do not cover at the end",
       geographic_miss_mm},
      {"stent_minimal_area_mm2", "mm2", "smallest area inside these stents at the end",
       [](const RunRecord& r) { return last_of(r, "stent_area_mm2"); }},
      {"stent_expansion_percent", "%", "that over the area of the reference diameter",
       [](const RunRecord& r) { return last_of(r, "stent_expansion_percent"); }},
      {"stent_apposed_percent", "%", "share of their struts' points no farther than 0.05 mm from the wall at the end",
       [](const RunRecord& r) { return last_of(r, "stent_apposed_percent"); }},
      {"ffr_model_before", "1",
       "fractional flow reserve of the flow model 20 mm behind the first lesion, at 93 mmHg and with the muscle's "
       "vessels as wide as they get, as the run begins",
       [](const RunRecord& r) { return event_value(r, EventCode::ffr_changes, false); }},
      {"ffr_model_after", "1", "the same at the end",
       [](const RunRecord& r) { return event_value(r, EventCode::ffr_changes, true); }},
      {"timi_frame_count_before", "1",
       "frames at 30/s, of the first injection that fills the first lesion's artery: from half of the undiluted "
       "concentration behind its ostium, or at a guide's tip that lies farther in, to 15 % at the landmark (Gibson "
       "1996); null: not reached in 10 s",
       [](const RunRecord& r) {
         const std::vector<double> frames = timi_frames(r);
         return frames.empty() ? none : frames.front();
       }},
      {"timi_frame_count_after", "1", "the same, of the last one",
       [](const RunRecord& r) {
         const std::vector<double> frames = timi_frames(r);
         return frames.empty() ? none : frames.back();
       }},
      {"occlusion_time_s", "s", "flow behind the lesion below 5 % of the muscle's need",
       [](const RunRecord& r) { return time_within(r, "flow_share", -1e300, occluded_share); }},
      {"bad_trace_time_s", "s", "the guide's last trace damped or ventricularised",
       [](const RunRecord& r) { return time_within(r, "trace", 0.5, 2.5); }},
      {"ST_max_mV", "mV", "largest shift in a lead", [](const RunRecord& r) { return most_of(r, "ST_mV"); }},
      {"injuries", "1", "dissections and perforations", [](const RunRecord& r) { return count(r, EventCode::injury); }},
      {"wire_perforation_chance_percent", "%",
       "how many in a hundred arteries the coronary wire's tip would have perforated by the end, whether it did or "
       "not: "
       "1 - exp(-H) of its hazard H (vascular/injury/injury.h)",
       [](const RunRecord& r) { return -100 * std::expm1(-last_of(r, "wire_hazard")); }}};
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
