/// Push and pull: its law against closed forms and against a wire's shape in its tube; clean sets, effects, bad input.
#include "data/identification/curves/push_pull/push_pull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/units.h"
#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/kinds.h"
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

/// Sum of the forces with which a wire presses by its stiffness.
double pressing(const std::vector<push_pull::Bend>& bends, double tip, double clearance,
                const std::vector<push_pull::StiffPiece>& stiffness, double spacing) {
  std::vector<push_pull::Touch> touches;
  double sum = 0;
  for (const push_pull::WallForce& f :
       push_pull::ChannelBeam(bends, 0, spacing).forces(tip, clearance, stiffness, touches)) {
    EXPECT_GT(f.force_N, 0) << f.at_m;
    sum += f.force_N;
  }
  return sum;
}

/// In a long bend a wire lies on the inner wall with the curvature 1/R. Where the bend ends it leaves that wall with
/// the moment EI / R and falls with a straight line of moments to the outer wall of the straight part, over a length l,
/// half of it in the bend: 2 c = l^2 / (6 R) - l^2 / (8 R), so l = sqrt(48 R c), and presses at either end of l with EI
/// / (R l). At a tip inside the bend, without a moment there, it falls over l = sqrt(12 R c).
TEST(PushPull, AStiffWirePressesAtEndsOfBendsAndAtItsTip) {
  constexpr double EI = 30, R = 20, c = 0.4;
  const double root = std::sqrt(R * c), unit = EI / (R * root), end = 2 / std::sqrt(48), tip = 2 / std::sqrt(12);
  for (const double spacing : {root / 2, root / 4, root / 8}) {
    // What is left is of second order in the spacing.
    const double near = 0.01 * std::pow(4 * spacing / root, 2) * unit;
    EXPECT_NEAR(pressing({{50, R, 2}}, 150, c, {{1e9, EI}}, spacing), unit * 2 * end, near) << spacing;
    EXPECT_NEAR(pressing({{50, R, 2}}, 50 + 8 * root, c, {{1e9, EI}}, spacing), unit * (end + tip), near) << spacing;
  }
  // A tip that is not yet deep enough in a bend to need the wall, and one that has just come to.
  EXPECT_EQ(pressing({{50, R, 2}}, 50 + 1.9 * root, c, {{1e9, EI}}, root / 8), 0);
  EXPECT_GT(pressing({{50, R, 2}}, 50 + 2.4 * root, c, {{1e9, EI}}, root / 8), 0);
}

struct SoftEnd {
  double length, EI, shaft_EI;
};
double soft_end(double from_tip, const void* data) {
  const auto& s = *static_cast<const SoftEnd*>(data);
  return from_tip < s.length ? s.EI : s.shaft_EI;
}

/// Paths, clearances and soft ends drawn at random, against shapes of least energy by an interior-point method.
TEST(PushPull, WallForcesAreThoseOfLeastEnergy) {
  std::mt19937 generator(7);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(generator()) / 4294967296.0;
  };
  double squares = 0, count = 0;
  for (int k = 0; k < 6; ++k) {
    std::vector<push_pull::Bend> bends;
    std::vector<synthetic::TubeBend> tube;
    for (double at = uniform(30, 50); tube.size() < 3;) {
      tube.push_back({at, uniform(12, 35), uniform(0.3, 2.2)});
      bends.push_back({tube.back().at, tube.back().radius, tube.back().angle});
      at = bends.back().end_m() + uniform(8, 45);
    }
    const SoftEnd wire{uniform(10, 90), uniform(2, 30), 30};
    const double c = uniform(0.15, 0.65);
    for (double tip = 20; tip < 240; tip += 22) {
      double theirs = 0;
      for (const synthetic::Touch& touch : synthetic::touches_of(tube, c, 0, tip, 0.3, soft_end, &wire))
        theirs += touch.force;
      const double ours = pressing(bends, tip, c, {{wire.length, wire.EI}, {1e9, wire.shaft_EI}}, 0.4);
      EXPECT_NEAR(ours, theirs, 0.02 * theirs + 0.01) << k << " " << tip;
      squares += (ours - theirs) * (ours - theirs), ++count;
    }
  }
  // N of wall force; a tenth of it is felt at the hand.
  EXPECT_LT(std::sqrt(squares / count), 4e-3);
}

TEST(PushPull, SamplesThatAreCloseTogetherAreInterpolated) {
  Rig setup = one_bend(30, 2);
  Passage& run = setup.runs[0];
  for (double x = 0.05; x < 0.12; x += 0.00317) {
    run.between_samples = false;
    const double exact = push_pull::hand_force(setup, run, x, 0.1, 1, 0.1);
    run.between_samples = true;
    EXPECT_NEAR(push_pull::hand_force(setup, run, x, 0.1, 1, 0.1), exact, 1e-3) << x;
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
  run.inserted_m = Eigen::VectorXd::LinSpaced(count, 0.2, 0.24), run.tip_N = Eigen::VectorXd::Zero(count);
  run.direction = Eigen::VectorXd::Ones(count);
  const double moving = push_pull::hand_force(setup, run, 0.2, 0, 1, 0.1);
  // Teeth of ten samples each, by which friction at rest has just built up.
  setup.sticking = 0.5, setup.hand_N_per_m = 0.5 * moving / (run.inserted_m[10] - run.inserted_m[0]);
  Eigen::VectorXd teeth(count);
  run.slips.assign(count, false);
  for (int k = 0; k < count; ++k) teeth[k] = moving * (1 + 0.05 * (k % 10)), run.slips[k] = k > 0 && k % 10 == 0;
  const auto slow = push_pull::hand_forces(setup)[0][0];
  EXPECT_LT((slow - teeth).cwiseAbs().maxCoeff(), 0.01 * moving);
  EXPECT_NEAR(slow.mean(), 1.225 * moving, 0.01 * moving);
  run.slips.clear();
  EXPECT_NEAR(push_pull::hand_forces(setup)[0][0].maxCoeff(), moving, 1e-9);
}

TEST(PushPull, SlipsAreFallsThatLast) {
  constexpr int count = 200;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(count);
  Eigen::VectorXd force(count), blunders = Eigen::VectorXd::Zero(count);
  for (int k = 0; k < count; ++k) force[k] = 0.004 * (k % 8);
  const std::vector<bool> slips = push_pull::falls_of(force, ones, 4e-3);
  ASSERT_EQ(slips.size(), count);
  for (std::size_t k = 1; k < count; ++k) EXPECT_EQ(slips[k], k % 8 == 0) << k;
  for (int k = 5; k < count; k += 20) blunders[k] = k % 40 == 5 ? 0.05 : -0.05;
  EXPECT_TRUE(push_pull::falls_of(blunders, ones, 4e-3).empty());
  EXPECT_TRUE(push_pull::falls_of(force, ones, 8e-3).empty());
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
