/// Fits of sets made by the boundary-value solver must find what was put in.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "data/catalogue/instrument/instrument_reader.h"
#include "data/identification/forward/prediction.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/selection/explain.h"
#include "tests/support/sets/synthetic_set.h"

namespace ostium::data {
namespace {

const FittedParameter& parameter(const FittedModel& model, const std::string& name) {
  for (const FittedParameter& p : model.parameters)
    if (p.parameter.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

void expect_within_three_sigma(const FittedModel& model, const std::string& name, double truth) {
  const FittedParameter& p = parameter(model, name);
  EXPECT_LT(std::fabs(p.value - truth), 3 * p.sigma) << name << " " << p.value << " +- " << p.sigma;
}

synthetic::Truth stiffness(double tip, double shaft, unsigned seed) {
  synthetic::Truth truth;
  truth.stiffness_scale = {{tip, shaft}};
  truth.sigma_m = 0.15e-3;
  truth.seed = seed;
  return truth;
}

TEST(Explanation, StiffnessOfAFreeWireIsFoundWithinThreeStandardErrors) {
  unsigned seed = 1;
  for (const auto& [tip, shaft] : {std::pair{1.35, 0.8}, std::pair{0.7, 1.3}, std::pair{1.0, 1.0}}) {
    MeasurementSet set = synthetic::free_wire(12);
    synthetic::measure(set, stiffness(tip, shaft, ++seed));
    const Explanation x = explain(set, {});
    EXPECT_EQ(x.verdict, Verdict::explained) << seed;
    expect_within_three_sigma(x.declared, "EI_scale[0][0]", tip);
    expect_within_three_sigma(x.declared, "EI_scale[0][1]", shaft);
    EXPECT_LT(parameter(x.declared, "EI_scale[0][1]").sigma, 0.02);
    // Noise floor of distances to a curve: two coordinates per point.
    const double floor = std::sqrt(2) * 0.15e-3;
    EXPECT_NEAR(x.declared.rms_m, floor, 0.09 * floor);  // four standard deviations of 1,040 numbers
    EXPECT_NEAR(*x.declared.rms_held_out_m, floor, 0.09 * floor);
    EXPECT_NEAR(*x.declared.chi2_per_dof, 1, 0.18);
  }
}

TEST(Explanation, NoiseIsToldFromPointToPoint) {
  MeasurementSet set = synthetic::free_wire(12);
  synthetic::measure(set, stiffness(1.2, 0.9, 5));
  set.imaging.noise_sigma_m.reset();
  const Explanation x = explain(set, {});
  ASSERT_TRUE(x.noise.sigma_m);
  EXPECT_NEAR(*x.noise.sigma_m, 0.15e-3, 0.1 * 0.15e-3);
  EXPECT_EQ(x.verdict, Verdict::explained);
  expect_within_three_sigma(x.declared, "EI_scale[0][1]", 0.9);
}

TEST(Explanation, ADifferenceThatNobodyDeclaredIsNotExplainedAway) {
  MeasurementSet set = synthetic::free_wire(12), world = set;
  // A permanent set of the shaft: 1 mm in 100 mm, in the material frame.
  world.instruments[0].sections[1].rest_curvature_per_m = {0, 0.2, 0};
  synthetic::measure(world, stiffness(1, 1, 3));
  set.experiments = world.experiments;
  const Explanation x = explain(set, {});
  EXPECT_EQ(x.verdict, Verdict::unexplained);
  EXPECT_GT(*x.declared.chi2_per_dof, 2);
  EXPECT_EQ(x.declared.residual_tests.signature.frame, "material");
  ASSERT_TRUE(x.declared.correlation);
  EXPECT_GT(x.declared.correlation->standard_errors, 4);
}

TEST(Explanation, ATwistingShaftIsFoundAndItsComplianceToo) {
  MeasurementSet set = synthetic::two_tubes(24);
  synthetic::Truth truth;
  truth.stiffness_scale = {{1.1, 1.1}, {0.95, 0.95}};
  truth.shaft_compliance = 1.4;
  truth.R = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized());
  truth.t_m = {0.02, -0.01, 0.05};
  truth.tip_offset_m = {0.004, -0.003, 0.006};
  truth.sigma_m = 0.3e-3;
  truth.seed = 2;
  synthetic::measure(set, truth);
  const Explanation x = explain(set, {{{"shaft_torsion"}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::effect);
  ASSERT_EQ(x.candidates.size(), 1u);
  EXPECT_GT(*x.declared.chi2_per_dof, 4);
  EXPECT_LT(*x.candidates[0].chi2_per_dof, 1 + 4 * std::sqrt(2 / 60.0));
  EXPECT_LT(*x.candidates[0].rms_held_out_m, 0.5 * *x.declared.rms_held_out_m);
  const FittedModel& found = x.candidates[0];
  expect_within_three_sigma(found, "shaft_torsion.compliance", 1.4);
  expect_within_three_sigma(found, "tip_offset.x_mm", 4);
  expect_within_three_sigma(found, "tip_offset.y_mm", -3);
  expect_within_three_sigma(found, "tip_offset.z_mm", 6);
  EXPECT_LT((found.view.R.conjugate() * truth.R).vec().norm(), 0.01);
  // Without loads only the ratio of stiffnesses can be determined.
  EXPECT_NEAR(parameter(found, "EI_scale[0]").value / parameter(found, "EI_scale[1]").value, 1.1 / 0.95, 0.1);

  const auto json = nlohmann::json::parse(to_json(x));
  EXPECT_EQ(json["verdict"], "effect");
  EXPECT_EQ(json["effects"], nlohmann::json({"shaft_torsion"}));
  EXPECT_LT(json["candidates"][0]["delta_bic"].get<double>(), -10);

  // The amended set contains the findings: its predictions, seen with the fitted view, are the fitted shapes.
  const std::string text = synthetic::to_json(set);
  const MeasurementSet after = read_measurement("amended/measurement.json", amended(text, set, x));
  const auto predictions = predict(after);
  for (std::size_t e = 0; e < predictions.size(); ++e)
    EXPECT_LT((predictions[e].shape.points_m.back() - found.shapes[e].points_m.back()).norm(), 1e-6);
}

TEST(Explanation, WithoutANoiseItCannotBeJudgedAndSaysWhatWouldLetIt) {
  MeasurementSet set = synthetic::two_tubes(16);
  synthetic::Truth truth;
  truth.sigma_m = 0.3e-3;
  synthetic::measure(set, truth);
  set.imaging.noise_sigma_m.reset();
  const Explanation x = explain(set, {});
  EXPECT_FALSE(x.noise.sigma_m);
  EXPECT_EQ(x.verdict, Verdict::cannot_be_judged);
  ASSERT_TRUE(x.next_experiment);
  EXPECT_NE(x.next_experiment->why.find("imaging.noise_sigma_mm"), std::string::npos);
  // What it asks for lets it be judged.
  set.imaging.noise_sigma_m = truth.sigma_m;
  EXPECT_EQ(explain(set, {}).verdict, Verdict::explained);
}

MeasurementSet bent_but_declared_straight() {
  MeasurementSet set = synthetic::free_wire(12), world = set;
  world.instruments[0].sections[1].rest_curvature_per_m = {0, 0.2, 0};
  synthetic::measure(world, stiffness(1, 1, 3));
  set.experiments = world.experiments;
  return set;
}

TEST(Explanation, EndedEarlyItTellsWhatItHas) {
  const MeasurementSet set = bent_but_declared_straight();
  ExplainOptions options;
  options.library = true;
  options.stop = [] { return true; };
  const Explanation x = explain(set, options);
  EXPECT_TRUE(x.ended_early);
  EXPECT_EQ(x.verdict, Verdict::unexplained);
  EXPECT_TRUE(x.candidates.empty());
  EXPECT_NE(x.verdict_text[1].find("Ended before everything was tried"), std::string::npos) << x.verdict_text[1];
  EXPECT_TRUE(nlohmann::json::parse(to_json(x))["ended_early"].get<bool>());
}

/// A fold, or the fit of a law, takes minutes in large sets.
TEST(Explanation, ItEndsWithinAFit) {
  const MeasurementSet set = bent_but_declared_straight();
  ExplainOptions options;
  options.library = true, options.threads = 1;
  std::vector<std::string> after;
  std::atomic<bool> ended = false;
  options.progress = [&](const std::string& words) {
    if (ended) after.push_back(words);
    // The first of an effect: what is declared is fitted in any case.
    if (words.find("fold 1") != std::string::npos && words.find("what is declared") == std::string::npos) ended = true;
  };
  options.stop = [&] { return ended.load(); };
  const Explanation x = explain(set, options);
  EXPECT_TRUE(ended && x.ended_early);
  EXPECT_TRUE(after.empty()) << after.size() << ", " << after[0];
  ASSERT_FALSE(x.candidates.empty());
  EXPECT_TRUE(std::none_of(x.candidates.begin(), x.candidates.end(),
                           [](const FittedModel& c) { return c.rms_held_out_m.has_value(); }));
}

/// Without an effect, none is found.
TEST(Explanation, AnEffectThatIsNotThereDoesNotWin) {
  MeasurementSet set = synthetic::two_tubes(16);
  synthetic::Truth truth;
  truth.sigma_m = 0.3e-3;
  synthetic::measure(set, truth);
  const Explanation x = explain(set, {{{"shaft_torsion"}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::explained);
  EXPECT_LT(parameter(x.candidates[0], "shaft_torsion.compliance").value, 0.2);
}

/// A pair of tubes of which the curved one relaxes: k = g E1 k1 / (g E1 + E2), computed by hand.
TEST(Explanation, RelaxationOfACurvedTubeIsFound) {
  MeasurementSet set = synthetic::two_tubes(1);
  set.imaging = {};
  set.imaging.noise_sigma_m = 0.3e-3;
  Experiment e = set.experiments[0];
  set.instruments[0].sections = {set.instruments[0].sections[0]};
  set.instruments[0].sections[0].to_tip_m = set.instruments[0].length_m;
  set.instruments[1].sections = {set.instruments[1].sections[0]};
  set.instruments[1].sections[0].to_tip_m = set.instruments[1].length_m;
  set.instruments[1].sections[0].rest_curvature_per_m.setZero();
  const double E1 = 5500, E2 = 2650, k1 = 13.6, f1 = 0.15, t1 = 50, f2 = 0.2, t2 = 700;
  set.experiments.clear();
  e.kind = Experiment::Kind::radius;
  e.points_m.clear();
  e.set = {{0.06, 0, 0}, {0.06, 0, 0}};
  unsigned wobble = 7;
  for (int i = 0; i < 24; ++i) {
    const double t = i == 0 ? 0 : 10 * std::pow(1.26, i);
    const double g = 1 - f1 * (1 - std::exp(-t / t1)) - f2 * (1 - std::exp(-t / t2));
    wobble = wobble * 1664525u + 1013904223u;
    e.id = "t" + std::to_string(i);
    e.elapsed_s = t;
    e.radius_m = (g * E1 + E2) / (g * E1 * k1) + 0.3e-3 * (wobble / 4294967296.0 - 0.5) * std::sqrt(12.0);
    set.experiments.push_back(e);
  }
  const Explanation x = explain(set, {{{"stress_relaxation"}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::effect);
  EXPECT_EQ(x.declared.residual_tests.signature.frame, "time");
  ASSERT_EQ(x.candidates.size(), 1u);
  expect_within_three_sigma(x.candidates[0], "stress_relaxation.fraction_1", f1);
  expect_within_three_sigma(x.candidates[0], "stress_relaxation.fraction_2", f2);
  EXPECT_LT(x.candidates[0].rms_m, 0.4e-3);

  // The exported instrument for `ostium run` contains the relaxation, and its sections are those before relaxation.
  const std::string name = nlohmann::json::parse(instrument_json(set, x, 0)).at("name").get<std::string>() + ".json";
  const Instrument curved = read_instrument(name, instrument_json(set, x, 0));
  EXPECT_NEAR(curved.relaxation.branches[0].fraction, f1, 0.05);
  EXPECT_NEAR(curved.relaxation.branches[1].fraction, f2, 0.06);
  EXPECT_NEAR(curved.relaxation.branches[1].time_s, t2, 0.5 * t2);
  EXPECT_NEAR(curved.sections[0].rest_curvature_per_m.norm(), k1, 1e-6 * k1);
  EXPECT_TRUE(rod_description(curved, equal_elements(curved.sections, 64)).relaxation.any());
  EXPECT_EQ(instrument_json(set, x, 1).find("relaxation\""), std::string::npos) << "the straight one";
}

TEST(Explanation, ThreadsDoNotChangeANumber) {
  MeasurementSet set = synthetic::free_wire(6);
  synthetic::measure(set, stiffness(1.1, 0.9, 4));
  EXPECT_EQ(to_json(explain(set, {{}, 1, {}})), to_json(explain(set, {{}, 3, {}})));
}

TEST(Explanation, WhatCannotBeTriedIsSaid) {
  const MeasurementSet set = synthetic::free_wire(4);
  EXPECT_THROW(explain(set, {{{"no_such_effect"}}, 0, {}}), LoadError);
  EXPECT_THROW(explain(set, {{{"shaft_torsion"}}, 0, {}}), LoadError);      // no shafts
  EXPECT_THROW(explain(set, {{{"stress_relaxation"}}, 0, {}}), LoadError);  // no times
  EXPECT_THROW(explain(synthetic::two_tubes(4), {{{"shaft_torsion[2]"}}, 0, {}}), LoadError);
}

}  // namespace
}  // namespace ostium::data
