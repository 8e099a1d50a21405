/// Metrics of records made by hand: the answers can be computed in the head.
#include "data/assessment/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace ostium::data {
namespace {

constexpr int code(EventCode c) { return static_cast<int>(c); }

double value(const RunRecord& record, const std::string& name) {
  for (const Metric& metric : metrics_of(record))
    if (metric.name == name) return metric.value;
  ADD_FAILURE() << name;
  return 0;
}

/// 10 s; one tool is fed at 50 mm/s for 4 s, drawn back at 100 mm/s for 1 s, and rests; the wall pushes with 2 N from 2
/// to 4 s.
RunRecord record() {
  RunRecord r{.step_s = 1e-3,
              .steps = 10000,
              .signal_columns = {"time_s", "heart_phase", "wire.inserted_mm", "wire.tip_branch", "wire.tip_along_mm",
                                 "wire.push_N", "wire.torque_mNm", "wire.wall_force_N", "wire.tip_force_N"},
              .signals = {},
              .events = {},
              .branches = {"aorta", "RCA"},
              .kerma_Gy = 2e-3,
              .dose_area_Gy_m2 = 3e-5};
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.01 * i, in = t < 4 ? 50 * t : t < 5 ? 200 - 100 * (t - 4) : 100;
    r.signals.insert(r.signals.end(),
                     {t, 0.0, in, t < 3 ? 0.0 : 1.0, in, t < 4 ? 0.5 : -0.7, 0.1, t >= 2 && t < 4 ? 2.0 : 0.0, 0.0});
  }
  r.events = {100,  double(code(EventCode::tool_in)),         0,  0,  //
              100,  double(code(EventCode::tip_enters)),      0,  0,  //
              2000, double(code(EventCode::fluoroscopy_on)),  -1, 0,  //
              3000, double(code(EventCode::tip_enters)),      0,  1,  //
              5000, double(code(EventCode::fluoroscopy_off)), -1, 0,  //
              6000, double(code(EventCode::cine_on)),         -1, 0,  //
              7500, double(code(EventCode::cine_off)),        -1, 0,  //
              9000, double(code(EventCode::fluoroscopy_on)),  -1, 0};
  return r;
}

/// A lesion of 10 mm, 1 mm wide in an artery of 4 mm; two inflations, at -2 to 10 and at 8 to 18 mm; a stent from -3 to
/// 14 mm, with a lumen of 3.8 mm. Flow stops from 2 to 4 s.
RunRecord treated() {
  RunRecord r{.step_s = 1e-3,
              .steps = 10000,
              .signal_columns = {"time_s",
                                 "lesion_mld_mm",
                                 "segment_mld_mm",
                                 "lesion_reference_mm",
                                 "lesion_length_mm",
                                 "balloon_from_mm",
                                 "balloon_to_mm",
                                 "balloon_atm",
                                 "balloon_ratio",
                                 "balloon_mm",
                                 "stent_from_mm",
                                 "stent_to_mm",
                                 "flow_share",
                                 "contrast_mL",
                                 "iodine_g",
                                 "trace",
                                 "ST_mV",
                                 "stent_area_mm2",
                                 "stent_expansion_percent",
                                 "stent_apposed_percent",
                                 "contrast_ostium",
                                 "contrast_landmark",
                                 "stenosis_worst_percent",
                                 "stent_margin_least_mm",
                                 "wire_hazard"},
              .signals = {},
              .events = {},
              .branches = {}};
  const double nan = std::nan("");
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.01 * i;
    const bool first = t >= 2 && t < 4, second = t >= 6 && t < 8, stent = t >= 8;
    // Injections: at 1 s, reaching the landmark 0.8 s later; a puff at 5 s, diluted on the way; at 8.5 s one that does
    // not move on.
    const double ostium = (t >= 1 && t < 3) || (t >= 5 && t < 5.2) || t >= 8.5 ? 0.9 : 0.0;
    const double landmark = t >= 1.8 && t < 4 ? 0.5 : 0.0;
    r.signals.insert(r.signals.end(), {t,
                                       stent ? 3.8 : 1.0,
                                       stent ? 3.6 : 1.0,
                                       4.0,
                                       10.0,
                                       first    ? -2.0
                                       : second ? 8.0
                                                : nan,
                                       first    ? 10.0
                                       : second ? 18.0
                                                : nan,
                                       first    ? 10.0
                                       : second ? 12.0
                                                : 0.0,
                                       first    ? 0.9
                                       : second ? 1.1
                                                : 0.0,
                                       first    ? 3.0
                                       : second ? 4.0
                                                : 0.0,
                                       stent ? -3.0 : nan,
                                       stent ? 14.0 : nan,
                                       first ? 0.01 : 1.0,
                                       t,
                                       0.3 * t,
                                       t < 1 ? 1.0 : 0.0,
                                       0.02 * t,
                                       stent ? 10.0 : nan,
                                       stent ? 80.0 : nan,
                                       stent ? 95.0 : nan,
                                       ostium,
                                       landmark,
                                       stent ? 12.0 : 75.0,
                                       stent ? 2.5 : nan,
                                       stent ? 0.2 : 0.0});
  }
  r.events = {0,    double(code(EventCode::ffr_changes)),      -1, 0.61,  //
              2000, double(code(EventCode::inflation_begins)), -1, 0,     //
              6000, double(code(EventCode::inflation_begins)), -1, 0,     //
              6500, double(code(EventCode::injury)),           -1, 11,    //
              9000, double(code(EventCode::ffr_changes)),      -1, 0.97};
  return r;
}

TEST(Metrics, OfHandsByPartOfTheProcedure) {
  const RunRecord r = record();
  EXPECT_EQ(value(r, "cannulation_movements"), 1);
  EXPECT_NEAR(value(r, "cannulation_speed_mean_mm_s"), 50, 1e-9);
  EXPECT_NEAR(value(r, "cannulation_path_ratio"), 1, 1e-9);
  // A step to 50 mm/s behind a low pass: the sum of a geometric series, over 2.89 s.
  const double share = 1 - std::exp(-2 * 3.14159265358979 * 2 * 0.01);
  EXPECT_NEAR(value(r, "cannulation_acceleration_mm_s2"), std::sqrt(2500 * share / 0.01 / (2 - share) / 2.89), 1e-6);
  EXPECT_EQ(value(r, "wiring_movements"), 1) << "there and back without a rest";
  EXPECT_NEAR(value(r, "wiring_speed_mean_mm_s"), 75, 1e-9) << "50 mm in, 100 mm back";
  EXPECT_NEAR(value(r, "wiring_path_ratio"), 1, 1e-9);
  EXPECT_TRUE(std::isnan(value(r, "treatment_movements"))) << "nothing was inflated";
}

/// Five times 0.3 s at 20 mm/s; rests of 0.2 s are none, those of 0.3 s are.
TEST(Metrics, HandsThatRestMoveOften) {
  for (const auto& [rest_s, wanted] : {std::pair{0.2, 1}, std::pair{0.3, 5}}) {
    RunRecord r = record();
    r.events = {0, double(code(EventCode::tool_in)), 0, 0};
    double inserted = 0;
    for (std::size_t i = 0; i < r.rows(); ++i) {
      const double in_turn = std::fmod(0.01 * static_cast<double>(i), 0.3 + rest_s);
      if (i > 0 && in_turn < 0.295 && 0.01 * static_cast<double>(i) < 5 * (0.3 + rest_s) - 1e-6) inserted += 0.2;
      r.signals[i * r.signal_columns.size() + 2] = inserted;
    }
    EXPECT_EQ(value(r, "cannulation_movements"), wanted) << rest_s;
  }
}

TEST(Metrics, OfATreatmentMadeByHand) {
  const RunRecord r = treated();
  EXPECT_NEAR(value(r, "residual_stenosis_percent"), 5, 1e-9);
  EXPECT_NEAR(value(r, "residual_stenosis_in_segment_percent"), 10, 1e-9);
  EXPECT_NEAR(value(r, "acute_gain_mm"), 2.8, 1e-9);
  EXPECT_NEAR(value(r, "balloon_artery_ratio"), 1.1, 1e-9);
  EXPECT_NEAR(value(r, "balloon_pressure_max_atm"), 12, 1e-9);
  EXPECT_EQ(value(r, "inflations"), 2);
  EXPECT_NEAR(value(r, "acute_recoil_percent"), 5, 1e-9) << "3.8 mm after 4.0";
  EXPECT_TRUE(std::isnan(value(r, "first_inflation_after_s"))) << "no tool came in";
  EXPECT_NEAR(value(r, "stent_margin_proximal_mm"), 3, 1e-9);
  EXPECT_NEAR(value(r, "stent_margin_distal_mm"), 4, 1e-9);
  EXPECT_NEAR(value(r, "residual_stenosis_worst_percent"), 12, 1e-9);
  EXPECT_NEAR(value(r, "stent_margin_least_mm"), 2.5, 1e-9);
  EXPECT_NEAR(value(r, "lesion_coverage_percent"), 100, 1e-9);
  EXPECT_NEAR(value(r, "geographic_miss_mm"), 4, 1e-9) << "14 to 18 mm";
  EXPECT_NEAR(value(r, "occlusion_time_s"), 2, 1e-6);
  EXPECT_NEAR(value(r, "bad_trace_time_s"), 1, 1e-6);
  EXPECT_NEAR(value(r, "contrast_volume_mL"), 9.99, 1e-6);
  EXPECT_NEAR(value(r, "iodine_g"), 2.997, 1e-6);
  EXPECT_NEAR(value(r, "ST_max_mV"), 0.1998, 1e-6);
  EXPECT_EQ(value(r, "injuries"), 1);
  EXPECT_NEAR(value(r, "wire_perforation_chance_percent"), 18.127, 1e-3);
  EXPECT_EQ(value(r, "stent_minimal_area_mm2"), 10);
  EXPECT_EQ(value(r, "stent_expansion_percent"), 80);
  EXPECT_EQ(value(r, "stent_apposed_percent"), 95);
  EXPECT_EQ(value(r, "ffr_model_before"), 0.61);
  EXPECT_EQ(value(r, "ffr_model_after"), 0.97);
  EXPECT_NEAR(value(r, "timi_frame_count_before"), 30 * 0.8, 0.1);
  EXPECT_TRUE(std::isnan(value(r, "timi_frame_count_after"))) << "it did not come through";
  // None of them applies to a run without a patient.
  for (const char* name :
       {"residual_stenosis_percent", "geographic_miss_mm", "occlusion_time_s", "ST_max_mV", "contrast_volume_mL",
        "lesion_coverage_percent", "balloon_artery_ratio", "stent_apposed_percent", "ffr_model_after",
        "timi_frame_count_before", "wire_perforation_chance_percent"})
    EXPECT_TRUE(std::isnan(value(record(), name))) << name;
}

TEST(Metrics, WhileBothPedalsAreDownTheBeamIsCine) {
  RunRecord r = record();
  r.events = {1000, double(code(EventCode::fluoroscopy_on)),  -1, 0,  //
              3000, double(code(EventCode::cine_on)),         -1, 0,  //
              4000, double(code(EventCode::fluoroscopy_off)), -1, 0,  //
              4500, double(code(EventCode::fluoroscopy_on)),  -1, 0,  //
              5000, double(code(EventCode::cine_off)),        -1, 0};
  EXPECT_NEAR(value(r, "fluoroscopy_time_s"), 2 + 5, 1e-12) << "to the end, at 10 s";
  EXPECT_NEAR(value(r, "cine_time_s"), 2, 1e-12);
}

TEST(Metrics, OfARecordMadeByHand) {
  const RunRecord r = record();
  EXPECT_DOUBLE_EQ(value(r, "procedure_time_s"), 10);
  EXPECT_NEAR(value(r, "cannulation_time_s"), 2.9, 1e-12);
  EXPECT_NEAR(value(r, "fluoroscopy_time_s"), 4, 1e-12) << "3 s, and the last one to the end";
  EXPECT_NEAR(value(r, "cine_time_s"), 1.5, 1e-12);
  EXPECT_DOUBLE_EQ(value(r, "cine_runs"), 1);
  EXPECT_NEAR(value(r, "air_kerma_mGy"), 2, 1e-12);
  EXPECT_NEAR(value(r, "dap_Gy_cm2"), 0.3, 1e-12);
  EXPECT_NEAR(value(r, "hand_path_length_mm"), 300, 1e-6);
  EXPECT_NEAR(value(r, "tip_path_length_mm"), 300, 10) << "in moves of 5 mm";
  EXPECT_NEAR(value(r, "tip_reached_mm"), 200, 0.5);
  EXPECT_NEAR(value(r, "all_tips_reached_mm"), 200, 0.5) << "there is one";
  EXPECT_NEAR(value(r, "wall_force_max_N"), 2, 1e-6);
  EXPECT_NEAR(value(r, "wall_force_mean_N"), 0.4, 0.01) << "a low pass moves an area, but keeps it";
  EXPECT_NEAR(value(r, "wall_force_impulse_N_s"), 4, 0.1);
  EXPECT_NEAR(value(r, "wall_force_above_limit_percent"), 20, 0.3) << "equally late at both ends";
  EXPECT_NEAR(value(r, "push_max_N"), 0.7, 1e-9);
  EXPECT_NEAR(value(r, "shaft_force_max_N"), 2, 1e-6);
  EXPECT_NEAR(value(r, "path_ratio"), 1, 1e-9) << "200 in, 100 back";
  EXPECT_NEAR(value(r, "blind_path_length_mm"), 100, 0.6) << "in the first two seconds";
  EXPECT_NEAR(value(r, "idle_beam_time_s"), 1.5 + 1, 0.03) << "cine from 6 s, fluoroscopy from 9 s";
}

TEST(Metrics, HintsAreCountedInLessons) {
  RunRecord r = record();
  EXPECT_TRUE(std::isnan(value(r, "hints_asked"))) << "no lesson";
  const auto add = [&](EventCode code) { r.events.insert(r.events.end(), {9000, double(int(code)), -1, 0}); };
  add(EventCode::instruction_done);
  EXPECT_EQ(value(r, "hints_asked"), 0);
  add(EventCode::hint_asked), add(EventCode::hint_asked);
  EXPECT_EQ(value(r, "hints_asked"), 2);
}

TEST(Metrics, WhatDoesNotApplyIsNoNumber) {
  RunRecord r = record();
  r.branches = {"aorta", "left renal"};
  EXPECT_TRUE(std::isnan(value(r, "cannulation_time_s")));
  const auto json = nlohmann::json::parse(metrics_json("a case", 3, "failure", "why \"not\"", metrics_of(r)));
  EXPECT_EQ(json["reason"], "why \"not\"");
  EXPECT_EQ(json["seed"], 3);
  EXPECT_EQ(json["metrics"].size(), metric_definitions().size());
  for (const auto& metric : json["metrics"])
    EXPECT_TRUE(metric["name"] != "cannulation_time_s" || metric["value"].is_null());
  EXPECT_EQ(value({}, "procedure_time_s"), 0);
}

TEST(Metrics, NamesAreSnakeCaseWithTheirUnitLast) {
  std::set<std::string> names;
  for (const MetricDefinition& d : metric_definitions()) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name;
    std::string ending = d.unit == "1" ? "" : "_" + d.unit;
    for (char& c : ending) c = c == ' ' || c == '/' ? '_' : c;
    if (d.unit == "%") ending = "_percent";
    EXPECT_TRUE(d.name.ends_with(ending)) << d.name;
    EXPECT_FALSE(d.definition.empty());
  }
  int next = 0;
  for (const EventDefinition& d : event_definitions()) EXPECT_EQ(code(d.code), next++) << d.name;
}

TEST(Metrics, ForPeopleTheyHaveTheirUnitOrSayNever) {
  EXPECT_EQ(value_text({"wall_force_max_N", 2.5071, "N"}), "2.507 N");
  EXPECT_EQ(value_text({"cine_runs", 3, "1"}), "3");
  EXPECT_EQ(value_text({"cine_time_s", 12.34, "s"}), "12.3 s");
  EXPECT_EQ(value_text({"cannulation_time_s", 412.7, "s"}), "6:52") << "as the clock of the run writes it";
  EXPECT_EQ(value_text({"perforation_to_covered_stent_s", never_s, "s"}), "never");
  EXPECT_EQ(value_text({"ascent_time_s", NAN, "s"}), "");
}

}  // namespace
}  // namespace ostium::data
