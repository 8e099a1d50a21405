/// Laws that no effect has are learned from sets made by solvers of their own, hold the truth in their bands, and are
/// driven.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "data/catalogue/instrument/instrument_reader.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/effects/bending_law.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/forward/prediction.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/selection/explain.h"
#include "tests/support/sets/bench_set.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::data {
namespace {

/// Nine of ten points of a law within its band of the truth, and the band narrow, where the data reach.
void expect_to_hold(const LearnedLaw& law, const std::function<double(double)>& truth) {
  std::size_t reached = 0, within = 0;
  std::vector<double> widths;
  for (std::size_t i = 0; i < law.sigma.size(); ++i) {
    if (!law.reached(i)) continue;
    const Eigen::Vector2d p = law.curve.points[i];
    ++reached, within += std::fabs(p.y() - truth(p.x())) < band_sigmas * law.sigma[i];
    widths.push_back(band_sigmas * law.sigma[i] / p.y());
  }
  ASSERT_GT(2 * reached, law.sigma.size());
  EXPECT_GE(10 * within, 9 * reached);
  std::sort(widths.begin(), widths.end());
  EXPECT_LT(widths[widths.size() / 2], 0.15);
}

synthetic::BenchSet bend(const std::string& content, unsigned seed) {
  for (const synthetic::BenchKind& kind : synthetic::bench_kinds())
    if (kind.name == "three_point_bend") return kind.make(content, 0, seed);
  throw std::runtime_error("no generator of three_point_bend");
}

class LawsOfABend : public testing::TestWithParam<const char*> {};

TEST_P(LawsOfABend, AreLearned) {
  const synthetic::BenchSet set = bend(GetParam(), 1);  // a set that they were developed on; fresh ones: RESULTS.md
  const JsonValue root = parse_json("set.json", set.json);
  const curves::CurveExplanation x = curves::explain_curves(root, {});
  ASSERT_TRUE(x.found()) << x.text[0];
  EXPECT_EQ(x.best().effects, set.effects);
  ASSERT_EQ(x.best().laws.size(), 1u);
  expect_to_hold(x.best().laws[0], set.law);
  EXPECT_LT(*x.best().model.held_out, 1.2);
  const auto json = nlohmann::json::parse(to_json(x));
  EXPECT_EQ(json["after"]["laws"][set.effects[0]]["table"].size(), x.best().laws[0].sigma.size());
}

INSTANTIATE_TEST_SUITE_P(Laws, LawsOfABend, testing::Values("law:locking", "law:many_sliders"),
                         [](const testing::TestParamInfo<const char*>& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), ':', '_');
                           return name;
                         });

/// Explained with one law alone, which is quicker than the library.
Explanation with_law(const synthetic::Undeclared& made, const std::string& law) {
  return explain(made.set, {{{law}}, 0, {}});
}

void expect_gates(const synthetic::Undeclared& made, const Explanation& x) {
  ASSERT_EQ(x.verdict, Verdict::effect) << x.verdict_text[0];
  ASSERT_EQ(x.best().laws.size(), 1u);
  expect_to_hold(x.best().laws[0], made.law);
  EXPECT_LT(*x.best().rms_held_out_m, 1.2 * std::sqrt(2.0) * *made.set.imaging.noise_sigma_m);
  const auto laws = nlohmann::json::parse(to_json(x))["after"]["laws"];
  EXPECT_EQ(laws[x.best().effects[0]]["table"].size(), x.best().laws[0].sigma.size());
  EXPECT_NE(to_html(made.set, x).find("What was learned"), std::string::npos);
}

/// What was learned is in the instrument's file, and a rod made of that has the found stiffness and bending.
void expect_to_be_driven(const synthetic::Undeclared& made, const Explanation& x) {
  const std::string text = instrument_json(made.set, x, 0);
  const Instrument found = read_instrument("instrument.json", text);
  const auto sections = setup_of(made.set, made.set.experiments[0], x.best().changes).nest.parts[0].sections;
  ASSERT_EQ(found.sections.size(), sections.size());
  for (std::size_t s = 0; s < sections.size(); ++s) {
    EXPECT_NEAR(found.sections[s].EI1_N_m2, sections[s].EI1_N_m2, 1e-9 * sections[s].EI1_N_m2);
    ASSERT_EQ(found.sections[s].bending.knots, sections[s].bending.knots);
    for (int j = 0; j < sections[s].bending.knots; ++j)
      EXPECT_NEAR(found.sections[s].bending.tangent[j], sections[s].bending.tangent[j], 1e-9);
  }
  // The amended set, with nothing fitted, predicts the fitted shapes.
  const MeasurementSet after = read_measurement("amended.json", amended(synthetic::to_json(made.set), made.set, x));
  const auto predictions = predict(after);
  for (std::size_t e = 0; e < predictions.size(); ++e)
    EXPECT_LT((predictions[e].shape.points_m.back() - x.best().shapes[e].points_m.back()).norm(), 1e-6);
}

TEST(Laws, StiffnessAlongTheInstrument) {
  const synthetic::Undeclared made = synthetic::undeclared_set("law:two_bumps", 1);
  const Explanation x = with_law(made, "law:stiffness");
  expect_gates(made, x);
  expect_to_be_driven(made, x);
}

TEST(Laws, BendingOfAnyForm) {
  const synthetic::Undeclared made = synthetic::undeclared_set("law:two_stage", 1);
  const Explanation x = with_law(made, "law:bending");
  expect_gates(made, x);
  expect_to_be_driven(made, x);
}

/// Where nothing is missing a law changes nothing, and does not win.
TEST(Laws, NoneIsFoundWhereThereIsNone) {
  const synthetic::Undeclared made = synthetic::undeclared_set("clean", 1);
  const Explanation x = with_law(made, "law:stiffness");
  EXPECT_EQ(x.verdict, Verdict::explained);
  ASSERT_EQ(x.candidates.size(), 1u);
  EXPECT_GT(x.candidates[0].bic, x.declared.bic - 6);
}

/// The share of the data, and the prior where there are none.
TEST(Laws, BandsAreThePriorsWhereDataDoNotReach) {
  const auto line = [](const Eigen::VectorXd& x) {
    LawCurve out{"law:test", "x", "1", "y", "1", {}, 0};
    out.points = {{0, x[0]}, {1, x[0] + x[1]}};
    return out;
  };
  const Eigen::Vector2d spread(0.5, 2);
  Eigen::Matrix2d known = Eigen::Matrix2d::Zero();
  known(0, 0) = 1e-4, known(1, 1) = 4;
  const LearnedLaw law = with_band(line, Eigen::Vector2d(1, 0), known, spread);
  EXPECT_NEAR(law.sigma[0], 0.01, 1e-9);
  EXPECT_TRUE(law.reached(0));
  EXPECT_NEAR(law.sigma[1], 2, 1e-4);
  EXPECT_FALSE(law.reached(1));
}

TEST(Laws, AMomentCurveInAFileIsReadAndRefused) {
  const synthetic::Undeclared made = synthetic::undeclared_set("clean", 1);
  const Explanation explained = explain(made.set, {});
  EXPECT_EQ(read_instrument("mine.json", instrument_json(made.set, explained, 0, "mine")).name, "mine");
  auto file = nlohmann::json::parse(instrument_json(made.set, explained, 0, "instrument"));
  auto& section = file["sections"]["list"][0];
  section["moment_curvature"] = {{"curvature_per_mm", {0.001, 0.003}}, {"tangent", {0.8, 0.3}}};
  const Instrument read = read_instrument("instrument.json", file.dump());
  EXPECT_EQ(read.sections[0].bending.knots, 2);
  EXPECT_NEAR(read.sections[0].bending.curvature_per_m[1], 3, 1e-12);
  section["moment_curvature"]["curvature_per_mm"] = {0.003, 0.001};
  EXPECT_THROW(read_instrument("instrument.json", file.dump()), LoadError);
  section["moment_curvature"] = {{"curvature_per_mm", {0.001}}, {"tangent", {0.001}}};
  EXPECT_THROW(read_instrument("instrument.json", file.dump()), LoadError);
}

}  // namespace
}  // namespace ostium::data
