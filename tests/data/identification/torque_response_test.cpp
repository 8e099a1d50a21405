/// Torque response: its law against closed forms and against an independent relaxation; clean sets, effects and bad
/// input.
#include "data/identification/curves/torque_response/torque_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/torque_response/twisted_chain.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/torque_set.h"

namespace ostium::data {
namespace {
namespace torque_response_test {

using Json = nlohmann::ordered_json;
using Rig = torque_response::Setup;
using torque_response::Turning, torque_response::TwistedChain;
using units::degree, units::mm, units::Nmm2;

/// 1 m of wire in contacts 300 and 500 mm from the drive, turned up to `most_deg` and back.
Rig two_contacts(double most_deg) {
  Rig setup;
  setup.sections = {{0, 1, 30 * Nmm2, 40 * Nmm2}};
  setup.radius_m = 0.2e-3, setup.friction = 0.1;
  Turning run;
  run.contacts = {{0.3, 0.5}, {0.5, 0.8}};
  run.proximal_rad = Eigen::Vector3d(0, most_deg, 0) * degree;
  setup.runs = {run};
  return setup;
}

TEST(TorqueResponse, LagIsTheTwistByFrictionOfAllContactsBehind) {
  const auto turned = torque_response::responses(two_contacts(360))[0];
  const double first = 0.1 * 0.5 * 0.2, last = 0.1 * 0.8 * 0.2;  // N mm
  const double lag = (first + last) * 300 / 30 + last * 200 / 30;
  EXPECT_NEAR(turned[0][1], 360 - lag / degree, 1e-6);
  EXPECT_NEAR(turned[1][1], first + last, 1e-9);
  EXPECT_NEAR(turned[0][2], lag / degree, 1e-6);
  EXPECT_NEAR(turned[1][2], -(first + last), 1e-9);
}

TEST(TorqueResponse, NothingArrivesBeforeEveryContactSlips) {
  const double last = 0.1 * 0.8 * 0.2, first = 0.1 * 0.5 * 0.2;
  const double slips = ((first + last) * 300 / 30 + last * 200 / 30) / degree;
  EXPECT_EQ(torque_response::responses(two_contacts(0.99 * slips))[0][0][1], 0);
  EXPECT_GT(torque_response::responses(two_contacts(1.01 * slips))[0][0][1], 0);
}

TEST(TorqueResponse, TorqueThatWindsUpMeetsTheStifferWire) {
  Rig setup = two_contacts(360);
  setup.handed = 4;
  const auto turned = torque_response::responses(setup)[0];
  const auto alike = torque_response::responses(two_contacts(360))[0];
  // Twice as stiff one way, half as stiff the other.
  EXPECT_NEAR(360 - turned[0][1], (360 - alike[0][1]) / 2, 1e-6);
  EXPECT_NEAR(turned[0][2], alike[0][2] * 2, 1e-6);
}

/// Energy of a wire that is curved at rest, with one place that pulls: k (p - a)^2 / 2 - m cos a.
TEST(TorqueResponse, WhipSnapsWhereTheAngleAtRestEnds) {
  const double k = 1, m = 3;
  TwistedChain wire({{1 / k, 0, {m, 0}}}, 1);
  // It holds on until k + m cos a = 0: then p = a + (m / k) sin a.
  const double a = std::acos(-k / m), p = a + m / k * std::sin(a);
  wire.turn(p - 0.01);
  EXPECT_LT(wire.distal_rad(), a);
  EXPECT_NEAR(k * (p - 0.01 - wire.distal_rad()), m * std::sin(wire.distal_rad()), 1e-8);
  wire.turn(p + 0.01);
  EXPECT_GT(wire.distal_rad(), a + 1);
  EXPECT_NEAR(k * (p + 0.01 - wire.distal_rad()), m * std::sin(wire.distal_rad()), 1e-8);
}

TEST(TorqueResponse, DriveWithPlayComesBackLaterByItsDeadBand) {
  Rig setup = two_contacts(360);
  const auto plain = torque_response::responses(setup)[0];
  setup.dead_rad = 10 * degree, setup.dead_at_start = 0.5;
  const auto played = torque_response::responses(setup)[0];
  EXPECT_NEAR(played[0][1] - plain[0][1], -5, 1e-6);
  EXPECT_NEAR(played[0][2] - plain[0][2], 5, 1e-6);
}

curves::CurveExplanation explained(const std::string& json, const std::vector<std::vector<std::string>>& tries = {}) {
  return curves::explain_curves(parse_json("set.json", json), {tries, {}, {}});
}

TEST(TorqueResponse, CleanSetsAreExplained) {
  for (unsigned seed = 901; seed < 905; ++seed) {
    const auto x = explained(synthetic::torque_kind().make("clean", 0, seed).json);
    EXPECT_EQ(x.verdict, Verdict::explained) << seed;
    EXPECT_NEAR(x.declared.model.rms(), 1, 0.1) << seed;
  }
}

/// Another effect is tried beside it.
class TorqueEffect : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(TorqueEffect, IsNamedAtThreeTimesTheNoise) {
  const auto [id, rival] = GetParam();
  const auto x = explained(synthetic::torque_kind().make(id, 3, 911).json, {{id}, {rival}});
  ASSERT_EQ(x.verdict, Verdict::effect) << id;
  EXPECT_EQ(x.best().effects, std::vector<std::string>{id});
  EXPECT_LT(x.best().model.rms(), 1.1);
}

INSTANTIATE_TEST_SUITE_P(All, TorqueEffect,
                         testing::Values(std::pair{"wall_friction", "handed_stiffness"},
                                         std::pair{"handed_stiffness", "wall_friction"},
                                         std::pair{"drive_slip", "drive_backlash"},
                                         std::pair{"drive_backlash", "wall_friction"}));

TEST(TorqueResponse, ExampleIsExplained) {
  const char* given = std::getenv("OSTIUM_MEASURED");
  const std::filesystem::path checkout = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  const std::filesystem::path file =
      (given ? std::filesystem::path(given) : checkout.parent_path() / "shared" / "measured") / "kinds" /
      "torque-example.json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "set OSTIUM_MEASURED to the folder of the measured sets";
  EXPECT_EQ(curves::explain_curves(load_json(file.string()), {}).verdict, Verdict::explained);
}

/// What the reader says of a clean set that `spoil` has changed.
template <class Spoil>
std::string refused(Spoil&& spoil) {
  Json file = Json::parse(synthetic::torque_kind().make("clean", 0, 1).json);
  spoil(file);
  return refusal_of([&] { curves::read_set(parse_json("set.json", file.dump())); });
}

TEST(TorqueResponse, BadInputIsNamed) {
  expect_words(refused([](Json& f) { f["runs"][2]["twist_deg"] = 1; }), {"runs[2]", "twist_deg"});
  expect_words(refused([](Json& f) { f["runs"][1]["distal_deg"].erase(0); }),
               {"runs[1].distal_deg", "expected", "proximal_deg"});
  expect_words(refused([](Json& f) { f["runs"][1]["contacts"][1]["at_mm"] = 3000; }),
               {"runs[1].contacts[1].at_mm", "1000"});
  expect_words(refused([](Json& f) { f["runs"][3]["id"] = "t1"; }), {"runs[3].id", "runs[1]"});
  expect_words(refused([](Json& f) { f["noise"]["distal_deg"] = -1; }), {"noise.distal_deg"});
  expect_words(refused([](Json& f) {
                 for (auto& angle : f["runs"][1]["distal_deg"])
                   angle = std::remainder(angle.template get<double>(), 360.0);
               }),
               {"runs[1].distal_deg", "began anew"});
  expect_words(refused([](Json& f) {
                 for (Json& run : f["runs"])
                   for (Json& turned : run["proximal_deg"]) turned = turned.get<double>() * degree;
               }),
               {"runs[0].proximal_deg", "radians"});
}

}  // namespace torque_response_test
}  // namespace
}  // namespace ostium::data
