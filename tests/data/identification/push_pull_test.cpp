/// Push and pull: its law against closed forms and against a wire's shape in its tube; clean sets, effects, bad input.
#include "data/identification/curves/push_pull/push_pull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/units.h"
#include "data/catalogue/catalogue.h"
#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/push_set.h"

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
  const auto worn = push_pull::hand_forces(setup).curves[0][0];
  EXPECT_NEAR(worn[1], push_pull::hand_force(setup, run, 0.21, 0, 1, 0.2), 1e-12);
}

/// A wire that is fed under constant friction in motion, a sample each half millimetre, and sticks: `teeth[k]` samples
/// in the tooth k, each of which rises by as much a sample. Noise: normal.
push_pull::SlidingRun sawed(const std::vector<int>& teeth, double friction_N, double rise_N, double sigma_N) {
  std::vector<double> built;
  for (const int samples : teeth)
    for (int k = 0; k < samples; ++k) built.push_back(rise_N * (k + 0.5));
  const auto n = static_cast<Eigen::Index>(built.size());
  push_pull::SlidingRun run;
  run.moving_N = run.friction_N = Eigen::VectorXd::Constant(n, friction_N);
  run.direction = Eigen::VectorXd::Ones(n), run.sigma_N = Eigen::VectorXd::Constant(n, sigma_N);
  run.inserted_m = Eigen::VectorXd::LinSpaced(n, 0.1, 0.1 + 0.5 * mm * static_cast<double>(n - 1));
  run.measured_N = run.moving_N + Eigen::Map<Eigen::VectorXd>(built.data(), n);
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, sigma_N);
  for (double& force : run.measured_N) force += noise(generator);
  return run;
}

double rms_of(const Eigen::VectorXd& x) { return std::sqrt(x.squaredNorm() / static_cast<double>(x.size())); }

TEST(PushPull, TeethAreForetoldFromThoseBefore) {
  // Ten samples of 5 mN: friction at rest is 50 mN more than the 100 in motion, give or take a tenth from slip to slip,
  // and builds up by 10 mN/mm.
  std::mt19937 generator(11);
  std::normal_distribution<double> wander(0, 1);
  std::vector<int> samples(60);
  for (int& tooth : samples) tooth = 10 + static_cast<int>(std::lround(wander(generator)));
  const push_pull::SlidingRun run = sawed(samples, 0.1, 5e-3, 2e-3);
  const push_pull::Sticking right{0.5, 10};
  const push_pull::SawTeeth teeth = push_pull::saw_teeth(run, right);
  const Eigen::VectorXd off = run.measured_N - run.moving_N - teeth.mean_N;
  // Who knows all samples before knows b but for whether it has slipped since: with the chance h of a sample to be the
  // first of a tooth, that is h (1 - h) of the square of its height.
  double unforeseen = 0, stands = 1;
  for (int k = 6; k < 15; ++k) {
    const double until = 0.5 * std::erfc((k + 0.5 - 10) / std::sqrt(2.0)), h = 1 - until / stands;
    unforeseen += stands * h * (1 - h), stands = until;
  }
  const double least = std::sqrt(unforeseen * 50e-3 * 50e-3 / 10 + 2e-3 * 2e-3);
  EXPECT_NEAR(rms_of(off.tail(500)), least, 0.1 * least);
  // What is said of how far off they are is so.
  const Eigen::VectorXd width = (teeth.spread_N.array().square() + 4e-6).sqrt();
  EXPECT_NEAR(rms_of(off.cwiseQuotient(width)), 1, 0.15);
  const double at_right = push_pull::surprise(run, teeth);
  for (const push_pull::Sticking& wrong : {push_pull::Sticking{0.5, 14}, {0.5, 7}, {0.35, 10}, {0.7, 10}})
    EXPECT_GT(push_pull::surprise(run, push_pull::saw_teeth(run, wrong)), at_right + 50) << wrong.static_more;
}

TEST(PushPull, TeethTooShortForSamplesAreAnywhere) {
  const push_pull::SlidingRun run = sawed(std::vector<int>(40, 10), 0.1, 5e-3, 2e-3);
  // 200 teeth a sample: b has the age of a renewal process, with moments E[T^2] / 2 E[T] and E[T^3] / 3 E[T] (Cox
  // 1962).
  const push_pull::SawTeeth teeth = push_pull::saw_teeth(run, {0.5, 20e3});
  constexpr double T = 50e-3, of_T = 0.1, mean = T * (1 + of_T * of_T) / 2;
  const double spread = std::sqrt(T * T * (1 + 3 * of_T * of_T) / 3 - mean * mean);
  EXPECT_LT((teeth.mean_N.array() - mean).abs().maxCoeff(), 1e-3 * T);
  EXPECT_LT((teeth.spread_N.array() - spread).abs().maxCoeff(), 1e-3 * T);
}

TEST(PushPull, NoTeethAreMoreLikelyWithoutThem) {
  const push_pull::SlidingRun run = sawed(std::vector<int>(40, 10), 0.1, 0, 2e-3);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(run.moving_N.size());
  const double without = push_pull::surprise(run, {none, none});
  for (const double more : {0.1, 0.3, 1.0})
    EXPECT_GT(push_pull::surprise(run, push_pull::saw_teeth(run, {more, 10})), without) << more;
}

TEST(PushPull, WhereToBeginIsTheLikeliestTooth) {
  std::mt19937 generator(5);
  std::vector<int> teeth(60);
  for (int& samples : teeth) samples = 7 + static_cast<int>(generator() % 3);
  push_pull::SlidingRun run = sawed(teeth, 0.1, 5e-3, 4e-3);
  run.measured_N.array() += 0.02;  // slow, so another matter
  const push_pull::Sticking found = push_pull::likely_sticking(run);
  EXPECT_NEAR(found.static_more * 0.1 / (found.stiffness_N_per_m * 0.5 * mm), 8, 0.8);  // samples a tooth
  EXPECT_NEAR(std::log(found.static_more / 0.4), 0, 0.5);
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
                                         std::pair{"stick_slip", "wall_friction"},
                                         std::pair{"zero_offset", "force_drift"},
                                         std::pair{"force_drift", "zero_offset"}));

/// Against the noise as declared: what the best effect leaves of so wrong a run, a hundred times the noise, is none.
TEST(PushPull, ARunInAnotherUnitIsNamedWithItsMend) {
  Json file = Json::parse(synthetic::push_kind().make("fault:gram_force", 0, 7301).json);
  for (Json& run : file["runs"])
    for (const char* key : {"time_s", "inserted_mm", "hand_force_N", "tip_force_N"}) {
      if (!run.contains(key)) continue;
      Json fewer = Json::array();
      for (std::size_t k = 0; k < run[key].size(); k += 4) fewer.push_back(run[key][k]);
      run[key] = fewer;
    }
  const auto x = explained(file.dump());
  ASSERT_EQ(to_string(x.verdict), "effect");
  ASSERT_TRUE(x.best().fault);
  EXPECT_EQ(x.best().fault->id, "unit_error");
}

/// The template, with what is inserted in centimetres in the runs from `from` to before `to`.
curves::CurveExplanation in_centimetres(std::size_t from, std::size_t to) {
  const auto file = std::filesystem::path(data_folder()) / "templates/push_pull/measurement.json";
  JsonValue root = curves::with_tables(load_json(file.string()));
  for (auto& [key, runs] : root.members)
    for (std::size_t r = from; key == "runs" && r < to; ++r)
      for (auto& [name, values] : runs.items[r].members)
        for (JsonValue& value : values.items)
          if (name == "inserted_mm") value.number /= 10;
  return curves::explain_curves(root, {});
}

/// A force that is divided until it vanishes beside the noise agrees with a wire that comes nowhere, too.
TEST(PushPull, AUnitThatLeavesNoSignalIsNotTheOne) {
  const auto x = in_centimetres(1, 2);
  ASSERT_TRUE(x.best().fault);
  EXPECT_EQ(x.best().fault->what, "inserted_mm of p2 is in cm");
}

/// It ended with a signal: there was nothing to fit.
TEST(PushPull, WhereNothingComesToABendNothingIsFreeAndItIsSaid) {
  const auto x = in_centimetres(0, 3);
  EXPECT_TRUE(x.set->free().empty());
  ASSERT_FALSE(x.warnings.empty());
  EXPECT_NE(x.warnings.back().find("No stiffness makes a difference"), std::string::npos) << x.warnings.back();
}

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
  expect_words(refused([](Json& f) { f["rig"]["friction"] = 10; }), {"rig.friction is 10", "at most 2"});
  expect_words(refused([](Json& f) {
                 f["rig"]["friction"] = 2;
                 f["runs"][0]["path"]["bends"] = {{{"at_mm", 0}, {"radius_mm", 5}, {"angle_deg", 3600}}};
               }),
               {"runs[0]: hand_force_N", "beyond 1e12 N"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bore_mm"] = 0.3; }), {"runs[0].path.bore_mm", "0.356"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bends"][1]["angle_deg"] = 1.57; }),
               {"runs[0].path.bends[1].angle_deg", "radians"});
  // A tube of a bend of no radius would take for ever.
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bends"][1]["radius_mm"] = 1e-300; }),
               {"runs[0].path.bends[1].radius_mm", "at least half the bore"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bends"][1]["angle_deg"] = 1e9; }),
               {"runs[0].path.bends[1].angle_deg", "at most 3600"});
  for (const double radius_mm : {1e-300, 0.009, 11.0, 1e300})
    expect_words(refused([&](Json& f) { f["instruments"][0]["outer_radius_mm"] = radius_mm; }),
                 {"instruments[0].outer_radius_mm", "0.01 to 10"});
  expect_words(refused([](Json& f) { f["runs"][0]["path"]["bends"][0]["length_mm"] = 30; }),
               {"runs[0].path.bends[0]", "either"});
  expect_words(refused([](Json& f) { f["runs"][4]["time_s"][7] = 0; }), {"runs[4].time_s[7]"});
  expect_words(refused([](Json& f) { f["runs"][0]["inserted_mm"][3] = 2000; }), {"runs[0].inserted_mm", "1000"});
}

}  // namespace push_pull_test
}  // namespace
}  // namespace ostium::data
