/// Contrast, lesion, balloon, stent, flow and injury.
#include <algorithm>
#include <cmath>
#include <utility>

#include "data/assessment/metric_functions.h"
#include "data/assessment/metrics.h"

namespace ostium::data {

namespace {

constexpr double endless = 1e300;

MetricFunction residual_percent(const std::string& diameter) {
  return
      [diameter](const RunRecord& r) { return 100 * (1 - last_of(r, diameter) / last_of(r, "lesion_reference_mm")); };
}

double coverage_percent(const RunRecord& r) {
  const double from = last_of(r, "stent_from_mm"), to = last_of(r, "stent_to_mm"),
               length = last_of(r, "lesion_length_mm");
  if (std::isnan(length)) return does_not_apply;
  return std::isnan(from) ? 0 : 100 * std::max(0.0, std::min(to, length) - std::max(from, 0.0)) / length;
}

/// Length that was diseased, or pressed by a balloon above 1 atm, and is not covered by a stent.
double geographic_miss_mm(const RunRecord& r) {
  const double length = last_of(r, "lesion_length_mm"), stent_from = last_of(r, "stent_from_mm"),
               stent_to = last_of(r, "stent_to_mm");
  if (std::isnan(length) || std::isnan(stent_from)) return does_not_apply;
  std::vector<std::pair<double, double>> spans = {{0, length}};
  const std::vector<double> from = all_of(r, "balloon_from_mm"), to = all_of(r, "balloon_to_mm"),
                            pressure = all_of(r, "balloon_atm");
  for (std::size_t i = 0; i < from.size(); ++i)
    if (pressure[i] > 1 && !std::isnan(from[i])) spans.emplace_back(from[i], to[i]);
  std::sort(spans.begin(), spans.end());
  double missed = 0, reached = -endless;
  for (auto [a, b] : spans) {
    a = std::max(a, reached), reached = std::max(reached, b);
    if (b <= a) continue;
    missed += b - a - std::max(0.0, std::min(b, stent_to) - std::max(a, stent_from));
  }
  return missed;
}

/// As measured on films: the balloon's diameter at the highest pressure of the last inflation against the lumen at the
/// end.
double acute_recoil_percent(const RunRecord& r) {
  const std::vector<double> pressure = all_of(r, "balloon_atm"), width = all_of(r, "balloon_mm");
  double highest = 1, widest = does_not_apply;
  for (std::size_t i = 0; i < width.size() && i < pressure.size(); ++i) {
    if (pressure[i] <= 1) highest = 1;
    if (pressure[i] > highest) highest = pressure[i], widest = width[i];
  }
  return 100 * (1 - last_of(r, "lesion_mld_mm") / widest);
}

double ffr_before(const RunRecord& r) {
  const std::vector<RecordedEvent> changes = events_of(r, EventCode::ffr_changes);
  return changes.empty() ? does_not_apply : changes.front().value;
}

double ffr_after(const RunRecord& r) {
  const std::vector<RecordedEvent> changes = events_of(r, EventCode::ffr_changes);
  return changes.empty() ? does_not_apply : changes.back().value;
}

/// TIMI frames of each injection that filled the ostium; NaN if contrast did not reach the landmark.
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
    // Contrast left from an earlier injection hides the new front.
    if (!fills || landmark[i] > seen_share) continue;
    const double begun = crossing(ostium, i, filled_share);
    std::size_t k = i;
    while (k < time.size() && landmark[k] <= seen_share && time[k] - begun < given_up_s) ++k;
    const bool reached = k < time.size() && landmark[k] > seen_share;
    // A short puff that is diluted before the landmark says nothing: the injection must last half a second.
    std::size_t full = i;
    while (full < time.size() && ostium[full] > filled_share) ++full;
    if (!reached && (full == time.size() ? time.back() : time[full]) - begun < 0.5) continue;
    out.push_back(reached ? per_s * (crossing(landmark, k, seen_share) - begun) : does_not_apply);
  }
  return out;
}

double timi_frames_before(const RunRecord& r) {
  const std::vector<double> frames = timi_frames(r);
  return frames.empty() ? does_not_apply : frames.front();
}

double timi_frames_after(const RunRecord& r) {
  const std::vector<double> frames = timi_frames(r);
  return frames.empty() ? does_not_apply : frames.back();
}

}  // namespace

std::vector<MetricDefinition> treatment_metrics() {
  using enum Better;
  return {
      {"contrast_volume_mL", "mL", lower, "out of the syringe, as undiluted contrast of 350 mg of iodine per mL",
       last("contrast_mL")},
      {"iodine_g", "g", lower, "that left the catheter", last("iodine_g")},
      {"residual_stenosis_percent", "%", lower,
       "of the first lesion at the end: 1 - smallest diameter within it over the reference, the healthy artery's mean "
       "of 5 mm ahead of it and behind it",
       residual_percent("lesion_mld_mm")},
      {"residual_stenosis_in_segment_percent", "%", lower, "the same with 5 mm on both sides of lesion and stents",
       residual_percent("segment_mld_mm")},
      {"residual_stenosis_worst_percent", "%", lower, "of the case's lesions, that of which most is left",
       last("stenosis_worst_percent")},
      {"acute_gain_mm", "mm", higher, "smallest diameter within the lesion at the end less that at the beginning",
       [](const RunRecord& r) { return last_of(r, "lesion_mld_mm") - first_of(r, "lesion_mld_mm"); }},
      {"acute_recoil_percent", "%", lower,
       "1 - smallest diameter within the first lesion at the end over the balloon's, at the last inflation's highest "
       "pressure",
       acute_recoil_percent},
      {"balloon_artery_ratio", "1", neither,
       "largest, over inflations, of the balloon's diameter between its markers over the healthy artery's there",
       most("balloon_ratio")},
      {"balloon_pressure_max_atm", "atm", neither, "largest pressure in a balloon", most("balloon_atm")},
      {"inflations", "1", neither, "times that the gauge rose above 1 atm", count_of(EventCode::inflation_begins)},
      {"stent_margin_proximal_mm", "mm", neither,
       "from the proximal end of the stents at the first lesion to its own, negative: inside the lesion; of several "
       "stents, the one that covers most of it and those that are joined to it without a gap",
       last("stent_from_mm", -1)},
      {"stent_margin_distal_mm", "mm", neither, "from the lesion's distal end to theirs, negative: inside the lesion",
       [](const RunRecord& r) { return last_of(r, "stent_to_mm") - last_of(r, "lesion_length_mm"); }},
      {"stent_margin_least_mm", "mm", higher,
       "least of these margins at both ends of all of the case's lesions; null: the artery of one has no stent",
       last("stent_margin_least_mm")},
      {"lesion_coverage_percent", "%", higher, "share of the first lesion's length that these stents lie in at the end",
       coverage_percent},
      {"geographic_miss_mm", "mm", lower,
       "length of the union of the first lesion and of all inflations above 1 atm nearer to it than to another lesion "
       "that these stents do not cover at the end",
       geographic_miss_mm},
      {"stent_minimal_area_mm2", "mm2", higher, "smallest area inside these stents at the end", last("stent_area_mm2")},
      {"stent_expansion_percent", "%", higher, "that over the area of the reference diameter",
       last("stent_expansion_percent")},
      {"stent_apposed_percent", "%", higher,
       "share of their struts' points no farther than 0.05 mm from the wall at the end", last("stent_apposed_percent")},
      {"ffr_model_before", "1", neither,
       "fractional flow reserve of the flow model 20 mm behind the first lesion, at 93 mmHg and with the muscle's "
       "vessels as wide as they get, as the run begins",
       ffr_before},
      {"ffr_model_after", "1", higher, "the same at the end", ffr_after},
      {"timi_frame_count_before", "1", neither,
       "frames at 30/s, of the first injection that fills the first lesion's artery: from half of the undiluted "
       "concentration behind its ostium, or at a guide's tip that lies farther in, to 15 % at the landmark (Gibson "
       "1996); null: not reached in 10 s",
       timi_frames_before},
      {"timi_frame_count_after", "1", lower, "the same, of the last one", timi_frames_after},
      {"occlusion_time_s", "s", lower, "flow behind the lesion below 5 % of the muscle's need",
       time_within("flow_share", -endless, occluded_share)},
      {"bad_trace_time_s", "s", lower, "the guide's last trace damped or ventricularised",
       time_within("trace", 0.5, 2.5)},
      {"ST_max_mV", "mV", lower, "largest shift in a lead", most("ST_mV")},
      {"injuries", "1", lower, "dissections and perforations", count_of(EventCode::injury)},
      {"wire_perforation_chance_percent", "%", lower,
       "how many in a hundred arteries the coronary wire's tip would have perforated by the end, whether it did or "
       "not: 1 - exp(-H) of its hazard H (vascular/injury/injury.h)",
       [](const RunRecord& r) { return -100 * std::expm1(-last_of(r, "wire_hazard")); }},
  };
}

}  // namespace ostium::data
