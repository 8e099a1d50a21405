/// Balloons under pressure: their law against closed forms, and sets of an independent solver against what they were
/// made with.
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

#include <cmath>

#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/kinds.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/inflation_set.h"

namespace ostium::data::pressure_diameter_test {
namespace {

using pressure_diameter::Chart;

constexpr double atm = 101325, mm = 1e-3;

/// A straight chart, 3 mm at 8 atm and 0.05 mm more with each, and pressures that rise to 14 atm and fall.
pressure_diameter::Setup straight(int vessel, bool stented) {
  pressure_diameter::Setup out;
  out.chart = Chart({2 * atm, 6 * atm, 10 * atm, 14 * atm}, {2.7 * mm, 2.9 * mm, 3.1 * mm, 3.3 * mm});
  out.vessels = {{"v", 2.8 * mm, 3.5 * mm, 4 * atm, 0.05 * atm, 5}};
  out.place_m = {0};
  Eigen::VectorXd p(25);
  for (int k = 0; k < 25; ++k) p[k] = (k <= 12 ? 2 + k : 26 - k) * atm;
  out.inflations = {{Eigen::VectorXd::LinSpaced(25, 0, 48), p, vessel, stented}};
  return out;
}

TEST(PressureDiameter, ChartIsMonotoneAndStraightBeyond) {
  const Chart chart({2, 6, 8, 14}, {2.0, 2.9, 3.0, 3.05});
  EXPECT_DOUBLE_EQ(chart(6), 2.9);
  for (double p = 0; p < 20; p += 0.1) EXPECT_GE(chart(p + 0.1), chart(p));
  EXPECT_NEAR(chart(18) - chart(16), chart(16) - chart(14), 1e-12);
}

TEST(PressureDiameter, BalloonAndWallShareThePressure) {
  const Eigen::VectorXd free = pressure_diameter::diameters(straight(-1, false))[0][0];
  EXPECT_NEAR(free[12], 3.3, 1e-9);
  const Eigen::VectorXd in = pressure_diameter::diameters(straight(0, false))[0][0];
  // d = 2.6 + 0.05 (p - 4 (d - 2.8) / 3.5), with p in atm and d in mm.
  for (const int p : {6, 10, 14}) EXPECT_NEAR(in[p - 2], (2.6 + 0.05 * (p + 4 * 2.8 / 3.5)) / (1 + 0.2 / 3.5), 1e-8);
  EXPECT_NEAR(in[0], free[0], 1e-12);  // 2.7 mm: it does not touch yet
  EXPECT_NEAR(in[24], free[24], 1e-12);
}

TEST(PressureDiameter, CounterPressureHoldsAtRest) {
  pressure_diameter::Setup setup = straight(0, false);
  setup.counter_Pa = 3 * atm;
  const Eigen::VectorXd d = pressure_diameter::diameters(setup)[0][0];
  EXPECT_NEAR(d[4], 2.8, 1e-9);  // 6 atm make 2.9 mm, and 3 of them are borne before the lumen opens
  EXPECT_NEAR(d[12], (2.6 + 0.05 * (14 - 3 + 4 * 2.8 / 3.5)) / (1 + 0.2 / 3.5), 1e-8);
}

TEST(PressureDiameter, AStentStaysOrSpringsBack) {
  pressure_diameter::Setup setup = straight(-1, true);
  EXPECT_NEAR(pressure_diameter::diameters(setup)[0][0][24], 3.3, 1e-9);
  setup.recoil = 0.07;
  EXPECT_NEAR(pressure_diameter::diameters(setup)[0][0][24], 3.3 * (1 - 0.07 * 12 / 14), 1e-9);
}

TEST(PressureDiameter, CreepIsTheIntegralOfPressure) {
  pressure_diameter::Setup setup = straight(-1, false);
  setup.inflations[0].pressure_Pa.setConstant(10 * atm);
  setup.creep_per_Pa_s = 1e-3 / 60 / atm;
  const Eigen::VectorXd d = pressure_diameter::diameters(setup)[0][0];
  EXPECT_NEAR(d[24], 3.1 * (1 + 1e-3 * 10 * 48 / 60), 1e-9);
}

curves::CurveExplanation explained(const std::string& json) {
  return curves::explain_curves(parse_json("made.json", json), {});
}

TEST(PressureDiameter, CleanSet) {
  EXPECT_EQ(explained(bench_sets::inflation_set("", 0, 21)).verdict, Verdict::explained);
}

TEST(PressureDiameter, NamesWhatIsUndeclared) {
  for (const std::string effect : {"counter_pressure", "recoil", "taper", "creep"}) {
    const curves::CurveExplanation x = explained(bench_sets::inflation_set(effect, 3, 22));
    EXPECT_EQ(x.verdict, Verdict::effect) << effect;
    ASSERT_FALSE(x.candidates.empty());
    EXPECT_EQ(x.candidates[0].effects, std::vector<std::string>{effect});
  }
}

TEST(PressureDiameter, WhatIsWrongIsNamed) {
  const std::string good = bench_sets::inflation_set("", 0, 23);
  const auto refused = [&](const std::string& what, const std::string& by) {
    std::string bad = good;
    const auto place = bad.find(what);
    EXPECT_NE(place, std::string::npos) << what;
    bad.replace(place, what.size(), by);
    return refusal_of([&] { curves::read_set(parse_json("made.json", bad)); });
  };
  expect_words(refused("\"places_mm\"", "\"place_mm\""), {"place_mm"});
  expect_words(refused("\"in\": \"v0\"", "\"in\": \"v7\""), {"runs[2].in", "free"});
  expect_words(refused("\"time_s\": [2, 4", "\"time_s\": [4, 4"), {"runs[0].time_s[1]", "more than the 4"});
  expect_words(refused("\"time_s\": [2, ", "\"time_s\": ["), {"runs[0].pressure_atm", "expected 33"});
  expect_words(refused("\"pressure_atm\": [2, 3", "\"pressure_atm\": [3, 3"), {"chart.pressure_atm[1]"});
}

}  // namespace
}  // namespace ostium::data::pressure_diameter_test
