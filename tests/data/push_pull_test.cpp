/// Push and pull: its law against closed forms and against a wire's shape in its tube; clean sets, effects, bad input.
#include "data/identification/curves/push_pull/push_pull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/base/units.h"
#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/push_pull/contact.h"
#include "tests/data/refusals.h"
#include "tests/support/push_set.h"

namespace ostium::data {
namespace {
namespace push_pull_test {

using Json = nlohmann::ordered_json;
using Rig = push_pull::Setup;
using push_pull::Passage;
using units::mm, units::Nmm2;

/// One bend of radius 20 mm that begins at 50 mm.
Rig one_bend(double EI_Nmm2, double angle_rad) {
  Rig setup;
  setup.sections = {{0, 1, EI_Nmm2 * Nmm2}};
  setup.radius_m = 0.2 * mm, setup.friction = 0.1;
  Passage run;
  run.bends = {{50 * mm, 20 * mm, angle_rad}};
  run.bore_radius_m = 0.6 * mm;
  setup.runs = {run};
  return setup;
}

TEST(PushPull, ALimpWireIsARopeAroundACapstan) {
  const Rig setup = one_bend(1e-9, 2);
  const Passage& run = setup.runs[0];
  // Euler and Eytelwein: exp(mu angle), against the motion.
  EXPECT_NEAR(push_pull::hand_force(setup, run, 0.2, 0.3, 1, 0.1), 0.3 * std::exp(0.2), 1e-6);
  EXPECT_NEAR(push_pull::hand_force(setup, run, 0.2, 0.3, -1, 0.1), 0.3 * std::exp(-0.2), 1e-6);
  EXPECT_NEAR(push_pull::hand_force(setup, run, 0.2, -0.3, -1, 0.1), -0.3 * std::exp(0.2), 1e-6);
}

TEST(PushPull, WithoutFrictionTheHandFeelsTheTip) {
  const Rig setup = one_bend(30, 2);
  EXPECT_DOUBLE_EQ(push_pull::hand_force(setup, setup.runs[0], 0.2, 0.3, 1, 0), 0.3);
}

double uniform(double, const void* EI) { return *static_cast<const double*>(EI); }

/// Sum of the forces with which a wire presses by its stiffness, from its shape of least energy.
double pressing(double EI, double radius, double angle, double clearance, double tip) {
  double sum = 0;
  for (const synthetic::Touch& touch :
       synthetic::touches_of({{50, radius, angle}}, clearance, 0, tip, 0.15, uniform, &EI))
    sum += touch.force;
  return sum;
}

TEST(PushPull, AStiffWirePressesAsItsShapeOfLeastEnergy) {
  constexpr double EI = 30, R = 20, c = 0.4;
  const double root = std::sqrt(R * c), unit = EI / (R * root), length = 2 * R;
  // The closed forms: an end of a long bend, and a tip in it.
  EXPECT_NEAR(pressing(EI, R, 2, c, 150), unit * 4 / std::sqrt(48), 0.01 * unit);
  EXPECT_NEAR(pressing(EI, R, 2, c, 50 + 8 * root), unit * (2 / std::sqrt(48) + 2 / std::sqrt(12)), 0.01 * unit);
  for (const double tip : {54.0, 58.0, 61.0, 64.0, 70.0, 80.0, 88.0, 92.0, 95.0, 100.0}) {
    const push_pull::ContactForces N = push_pull::contact_forces((tip - 50) / root, length / root);
    EXPECT_NEAR((N.at_beginning + N.at_end) * unit, pressing(EI, R, 2, c, tip), 0.025 * unit) << tip;
  }
  // A short bend, by half of which the wire is not bent at all.
  const push_pull::ContactForces N = push_pull::contact_forces(100 / root, 0.4 * R / root);
  EXPECT_NEAR((N.at_beginning + N.at_end) * unit, pressing(EI, R, 0.4, c, 150), 0.03 * unit);
}

double half_as_soft(double from_tip, const void* share) {
  return from_tip < 80 ? 30 * *static_cast<const double*>(share) : 30;
}

TEST(PushPull, AChangeOfStiffnessInABendPressesToo) {
  constexpr double R = 20, c = 0.4;
  const double unit = 30 / (R * std::sqrt(R * c));
  for (const double share : {0.1, 0.25, 0.6}) {
    double sum = 0;
    for (const synthetic::Touch& touch : synthetic::touches_of({{50, R, 2}}, c, 0, 150, 0.15, half_as_soft, &share))
      sum += touch.force;
    const double ends = (1 + share) * 2 / std::sqrt(48);
    // The ends of the bend are only just far enough away not to matter.
    EXPECT_NEAR(sum / unit, ends + push_pull::contact::at_change(share), 0.05) << share;
  }
}

TEST(PushPull, AWornCoatingRubsByTheDistanceRun) {
  Rig setup = one_bend(30, 2);
  Passage& run = setup.runs[0];
  run.inserted_m = Eigen::Vector2d(0.2, 0.21), run.tip_N = Eigen::Vector2d::Zero();
  run.direction = Eigen::Vector2d::Ones(), run.run_before_m = 0.99;
  setup.worn_per_m = 1;
  const auto worn = push_pull::hand_forces(setup)[0][0];
  EXPECT_NEAR(worn[1], push_pull::hand_force(setup, run, 0.21, 0, 1, 0.2), 1e-12);
}

TEST(PushPull, SawTeethAreAsHighAsFrictionAtRestIsMore) {
  Rig setup = one_bend(30, 2);
  Passage& run = setup.runs[0];
  const int count = 400;
  run.inserted_m = Eigen::VectorXd::LinSpaced(count, 0.2, 0.22), run.tip_N = Eigen::VectorXd::Zero(count);
  run.direction = Eigen::VectorXd::Ones(count), run.time_s = Eigen::VectorXd::LinSpaced(count, 0, 20);
  const double moving = push_pull::hand_force(setup, run, 0.2, 0, 1, 0.1);
  setup.sticking = 0.5, setup.hand_N_per_m = 20, setup.sticks_below_m_s = 2e-3;
  const auto slow = push_pull::hand_forces(setup)[0][0];
  EXPECT_NEAR(slow.maxCoeff(), 1.5 * moving, 0.02 * moving);
  EXPECT_NEAR(slow.mean(), 1.25 * moving, 0.05 * moving);
  setup.sticks_below_m_s = 1e-4;
  EXPECT_NEAR(push_pull::hand_forces(setup)[0][0].maxCoeff(), moving, 1e-9);
}

curves::CurveExplanation explained(const std::string& json, const std::vector<std::vector<std::string>>& tries = {}) {
  return curves::explain_curves(parse_json("set.json", json), {tries, {}, {}});
}

TEST(PushPull, CleanSetsAreExplained) {
  for (unsigned seed = 901; seed < 904; ++seed) {
    const auto x = explained(synthetic::push_kind().make("clean", 0, seed).json);
    EXPECT_EQ(x.verdict, Verdict::explained) << seed;
    EXPECT_LT(x.declared.model.rms(), 1.2) << seed;
  }
}

class PushEffect : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(PushEffect, IsNamedAtThreeTimesTheNoise) {
  const auto [id, rival] = GetParam();
  const auto x = explained(synthetic::push_kind().make(id, 3, 911).json, {{id}, {rival}});
  ASSERT_TRUE(x.found()) << id << " " << to_string(x.verdict);
  EXPECT_EQ(x.best().effects, std::vector<std::string>{id});
  EXPECT_GT(x.best().share_removed, 0.5);
}

INSTANTIATE_TEST_SUITE_P(All, PushEffect,
                         testing::Values(std::pair{"coating_loss", "force_drift"},
                                         std::pair{"zero_offset", "force_drift"},
                                         std::pair{"force_drift", "zero_offset"}));

template <class Spoil>
std::string refused(Spoil&& spoil) {
  Json file = Json::parse(synthetic::push_kind().make("clean", 0, 1).json);
  spoil(file);
  return refusal_of([&] { curves::read_set(parse_json("set.json", file.dump())); });
}

TEST(PushPull, BadInputIsNamed) {
  expect_words(refused([](Json& f) { f["runs"][2]["speed"] = 1; }), {"runs[2]", "speed"});
  expect_words(refused([](Json& f) { f["runs"][1]["hand_force_N"].erase(0); }),
               {"runs[1].hand_force_N", "expected", "inserted_mm"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bore_mm"] = 0.3; }), {"runs[0].path.bore_mm", "0.356"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bends"][1]["angle_deg"] = 1.57; }),
               {"runs[0].path.bends[1].angle_deg", "radians"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bends"][0]["length_mm"] = 30; }),
               {"runs[0].path.bends[0]", "either"});
  expect_words(refused([](Json& f) { f["runs"][4]["time_s"][7] = 0; }), {"runs[4].time_s[7]"});
  expect_words(refused([](Json& f) { f["runs"][0]["inserted_mm"][3] = 2000; }), {"runs[0].inserted_mm", "1000"});
}

}  // namespace push_pull_test
}  // namespace
}  // namespace ostium::data
