/// The operator of a script: what ends a step, where a failure leads, which conditions are checked.
#include "app/session/operator/operator.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "app/session/run/play.h"
#include "core/base/units.h"
#include "data/catalogue/catalogue.h"
#include "tests/app/session/played.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

TEST(Operator, SaysWhyItFailed) {
  const PlayReport pushed =
      played(tube_setup(with(there_and_back, "\"push_exceeds_N\": 5", "\"wall_force_exceeds_N\": 0.001")));
  EXPECT_EQ(pushed.outcome, "failure");
  EXPECT_EQ(pushed.reason, "step 2 of 5, advance (to the bend): wall_force_exceeds_N 0.001");
  const PlayReport late = played(tube_setup(with(there_and_back, "\"timeout_s\": 5", "\"timeout_s\": 0.5")));
  EXPECT_EQ(late.outcome, "failure");
  EXPECT_EQ(late.reason, "step 2 of 5, advance (to the bend): timed out after 0.5 s, waiting for tip_passes bend");
  EXPECT_NEAR(late.simulated_s, 0.5, 0.01);
  const PlayReport anyhow =
      played(tube_setup(with(there_and_back, "\"timeout_s\": 5", "\"timeout_s\": 0.5, \"otherwise\": \"go on\"")));
  EXPECT_EQ(anyhow.outcome, "success");
}

TEST(Operator, WhatDidNotGoInWasNotFed) {
  const std::string script = R"({ "schema": "ostium-script/1", "name": "far", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [ { "do": "withdraw", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 50 }], "timeout_s": 1 } ] })";
  ScriptedRun run(tube_setup(script), tube_vessel());
  while (run.tick()) {
  }
  EXPECT_EQ(run.outcome, Outcome::timed_out) << "it was out already";
  EXPECT_EQ(run.state.hands[0].fed_m, 0);
  EXPECT_EQ(run.state.hands[0].path_m, 0);
}

TEST(Operator, TriesAgainAsOftenAsItSays) {
  const std::string script = R"({ "schema": "ostium-script/1", "name": "tries", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "advance", "label": "again", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 10 }] },
      { "do": "wait", "until": [{ "seconds": 9 }], "timeout_s": 0.1, "otherwise": "again", "tries": 3 } ] })";
  const RunSetup setup = tube_setup(script);
  ScriptedRun run(setup, tube_vessel());
  while (run.tick()) {
  }
  EXPECT_EQ(run.outcome, Outcome::timed_out);
  EXPECT_NEAR(run.state.hands[0].fed_m, 0.04, 0.001) << "once, and three times again";
}

TEST(Operator, HasALastResortWhenTriesAreUsedUp) {
  const std::string script = R"({ "schema": "ostium-script/1", "name": "resort", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "advance", "label": "far back", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 10 }] },
      { "do": "advance", "label": "again", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 1 }] },
      { "do": "wait", "until": [{ "seconds": 9 }], "timeout_s": 0.1, "otherwise": "again", "tries": 3,
        "last_resort": "far back" } ] })";
  ScriptedRun run(tube_setup(script), tube_vessel());
  while (run.tick()) {
  }
  EXPECT_EQ(run.outcome, Outcome::timed_out);
  EXPECT_NEAR(run.state.hands[0].fed_m, 2 * (0.01 + 4 * 0.001), 0.001);
}

/// Steps skip a detour without using time; a jump to its label goes through it.
TEST(Operator, TakesADetourOnlyWhereALabelLeadsToIt) {
  for (const double needed_mm : {5., 25.}) {
    const std::string script = R"({ "schema": "ostium-script/1", "name": "detour", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "advance", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 10 }] },
      { "do": "advance", "label": "more", "detour": true, "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 8 }] },
      { "do": "advance", "detour": true, "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 2 }] },
      { "do": "wait", "until": [{ "inserted_mm": )" +
                               std::to_string(needed_mm) +
                               R"(, "of": "wire" }], "timeout_s": 0.1, "otherwise": "more", "tries": 3 } ] })";
    ScriptedRun run(tube_setup(script), tube_vessel());
    int begun = 0;
    while (run.tick())
      for (const OperatorEvent& event : run.events) begun += event.kind == OperatorEvent::Kind::begins;
    EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
    const double fed_m = run.state.hands[0].fed_m;
    EXPECT_NEAR(fed_m, needed_mm < 10 ? 0.01 : 0.03, 0.001);
    EXPECT_EQ(begun, needed_mm < 10 ? 2 : 8);
  }
}

/// "Is this needed?": a wait whose `unless` holds at once skips unnecessary steps; one whose `until` holds first does
/// not.
TEST(Operator, LeavesOutStepsThatAreNotNeeded) {
  for (const bool needed : {false, true}) {
    const std::string script = R"({ "schema": "ostium-script/1", "name": "leaves-out", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "advance", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 20 }] },
      { "do": "wait", "label": "more is needed", "until": [{ "seconds": 0.1 }],
        "unless": [{ "inserted_mm": )" +
                               std::string(needed ? "30" : "10") +
                               R"(, "of": "wire" }], "otherwise": "the end", "tries": 1 },
      { "do": "advance", "tool": "wire", "speed_mm_s": 100, "until": [{ "fed_mm": 15 }] },
      { "do": "mark", "label": "the end", "text": "the end" } ] })";
    const RunSetup setup = tube_setup(script);
    ScriptedRun run(setup, tube_vessel());
    while (run.tick()) {
    }
    EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
    EXPECT_NEAR(run.state.hands[0].fed_m, needed ? 0.035 : 0.02, 0.001);
  }
}

TEST(Operator, LooksAtWhereTheTipPointsAndWhetherItIsOut) {
  const std::string script = R"({ "schema": "ostium-script/1", "name": "points", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "amplatz-super-stiff" } ],
    "steps": [
      { "do": "advance", "tool": "wire", "speed_mm_s": 100, "until": [{ "tip_points": "head", "within_deg": 25 }], "timeout_s": 3 },
      { "do": "withdraw", "tool": "wire", "speed_mm_s": 200, "until": [{ "out": true }], "timeout_s": 5 } ] })";
  const RunSetup setup = tube_setup(script);
  ScriptedRun run(setup, tube_vessel());
  Eigen::Vector3d pointed = Eigen::Vector3d::Zero();
  while (run.tick())
    if (run.hands.step == 1 && pointed.isZero()) pointed = tip_direction(run.model, run.state, 0);
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
  EXPECT_GT(pointed.y(), std::cos(27 * units::pi / 180)) << "the tube's far end runs along y";
  EXPECT_FALSE(run.report.tools[0].in_body);
}

TEST(Operator, TurnsAHubBackToHowItCameIn) {
  const RunSetup setup = tube_setup(R"({ "schema": "ostium-script/1", "name": "hub", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "turn", "tool": "wire", "turn_deg_s": -400, "until": [{ "turned_deg": 100 }], "timeout_s": 1 },
      { "do": "turn", "tool": "wire", "turn_deg_s": -400, "until": [{ "turned_deg": 300 }], "timeout_s": 1 },
      { "do": "turn", "tool": "wire", "turn_deg_s": 400, "until": [{ "hub_within_deg": 10 }], "timeout_s": 2 } ] })");
  ScriptedRun run(setup, tube_vessel());
  while (run.tick()) {
  }
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
  // Whole turns count, so -400 degrees are not near 0; at most two steps late, of 0.4 degrees each.
  EXPECT_NEAR(run.state.hands[0].turned_rad * 180 / units::pi, -10, 0.9);
}

/// The step at which a wait ends when the tip has moved by `at(step)` mm and the hand by `hand(step)` mm.
template <class At, class Hand>
std::uint64_t ends_waiting(const std::string& until, At&& at, Hand&& hand) {
  const RunSetup setup = tube_setup(R"({ "schema": "ostium-script/1", "name": "waits", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [ { "do": "wait", "timeout_s": 3, "until": [{ )" +
                                    until + " }] } ] }");
  ScriptedRun run(setup, tube_vessel());
  SessionState state = make_state(run.model, 0);
  state.rods.rods[0].inserted_m = 0.1, state.rods.rods[0].first = 0;
  const int last = run.model.rods.rods[0].elements;
  SessionReport report;
  report.tools.resize(1);
  while (state.rods.step < 4000) {
    state.rods.rods[0].position.set(last, Eigen::Vector3d(0.1 + 1e-3 * at(state.rods.step), 0, 0));
    state.hands[0].fed_m = 1e-3 * hand(state.rods.step);
    if (decide(run.plan, run.model, state, report, run.hands, run.inputs, run.events) == Outcome::success)
      return state.rods.step;
    ++state.rods.step;
    state.blood.heart.phase += 0.00125;  // 75 beats a minute
    if (state.blood.heart.phase >= 1) state.blood.heart.phase -= 1, state.blood.heart.beats += 1;
  }
  return 0;
}

TEST(Operator, SeesATipDropButNotAHandThatMoves) {
  const auto drop = [](std::uint64_t step) { return step < 1000 ? 0.0 : 8.0; };
  const auto still = [](std::uint64_t) { return 0.0; };
  const auto slowly = [](std::uint64_t step) { return 0.01 * static_cast<double>(step); };  // 10 mm/s: 2.5 mm in 0.25 s
  EXPECT_EQ(ends_waiting("\"tip_drops_mm\": 5", drop, still), 1000u);
  EXPECT_EQ(ends_waiting("\"tip_drops_mm\": 5", drop, drop), 0u);
  EXPECT_EQ(ends_waiting("\"tip_drops_mm\": 5", slowly, slowly), 0u);
  EXPECT_EQ(ends_waiting("\"tip_drops_mm\": 5", slowly, still), 0u);
}

TEST(Operator, CountsBeatsAndSeconds) {
  const auto still = [](std::uint64_t) { return 0.0; };
  EXPECT_NEAR(static_cast<double>(ends_waiting("\"beats\": 3", still, still)), 3 / 0.00125, 1);
  EXPECT_EQ(ends_waiting("\"seconds\": 1.5", still, still), 1500u);
}

TEST(Operator, ExchangesOneToolForAnother) {
  const std::string script = R"({ "schema": "ostium-script/1", "name": "exchange", "title": "A test",
    "tools": [ { "name": "first", "instrument": "cook-j" }, { "name": "second", "instrument": "terumo-stiff-angled" } ],
    "steps": [
      { "do": "advance", "tool": "first", "speed_mm_s": 150, "until": [{ "inserted_mm": 80 }] },
      { "do": "withdraw", "tool": "first", "speed_mm_s": 150, "until": [{ "out": true }], "timeout_s": 5 },
      { "do": "advance", "tool": "second", "speed_mm_s": 150, "until": [{ "tip_passes": "bend" }], "timeout_s": 5 } ],
    "landmarks": [ { "name": "bend", "at_mm": [142, 18, 0] } ] })";
  ScriptedRun run(tube_setup(script), tube_vessel());
  while (run.tick()) EXPECT_FALSE(run.report.tools[0].in_body && run.report.tools[1].in_body);
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
  EXPECT_FALSE(run.report.tools[0].in_body);
  EXPECT_TRUE(run.report.tools[1].in_body);
  EXPECT_EQ(run.troubled, 0);
}

TEST(Operator, APlaceThatIsNotThereIsNamed) {
  const RunSetup setup = tube_setup(with(there_and_back, "\"tip_passes\": \"bend\"", "\"tip_passes\": \"bent\""));
  try {
    ScriptedRun run(setup, tube_vessel());
    FAIL();
  } catch (const data::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("there-and-back.json:8: there is no place \"bent\""), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("bend"), std::string::npos);
  }
}

TEST(ScriptFiles, AnInstrumentIsLookedForFromTheScriptsFolderFirst) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / ("ostium-script-files-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fs::path known = fs::path(data::data_folder()) / "instruments" / "cook-j.json";
  fs::copy_file(known, folder / "cook-j.json", fs::copy_options::overwrite_existing);
  const auto script = [&](const std::string& instrument) {
    return data::read_script(
        (folder / "one.json").string(),
        R"({ "schema": "ostium-script/1", "name": "one", "title": "One", "tools": [ { "name": "wire",
                                  "instrument": ")" +
            instrument + R"(" } ], "steps": [ { "do": "fluoroscopy", "on": true } ] })");
  };
  RunSetup setup;
  set_script(script("cook-j.json"), setup);
  EXPECT_EQ(setup.tool_files.front(), (folder / "cook-j.json").string());
  set_script(script("cook-j"), setup);
  EXPECT_EQ(setup.tool_files.front(), known.string());
  try {
    set_script(script("none.json"), setup);
    ADD_FAILURE() << "accepted";
  } catch (const data::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("\"none.json\" in " + folder.string()), std::string::npos) << error.what();
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace ostium::app
