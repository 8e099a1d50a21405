/// A session's lists, its operator, and that the same run is the same to the bit, however it is run.
#include "app/session/session.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "app/session/play.h"
#include "app/session/settled_branch.h"
#include "tests/core/allocations.h"
#include "tests/session/tube_vessel.h"

namespace ostium {
namespace {

PlayReport played(const RunSetup& setup, bool real = false, RecordMode mode = RecordMode::none) {
  ScriptedRun run(setup, tube_vessel());
  PlayOptions options;
  options.recorder.mode = mode;
  options.recorder.penetration = false;
  options.real = real;
  return play(run, setup, options);
}

std::string with(std::string script, const std::string& from, const std::string& to) {
  const std::size_t at = script.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return script.replace(at, from.size(), to);
}

TEST(Session, ListsHoldEverything) {
  ScriptedRun run(tube_setup(), tube_vessel());
  for (int i = 0; i < 300; ++i) run.tick();
  std::vector<double> row(state_count(run.model));
  put_state(run.state, row.data());
  SessionState back = make_state(run.model, 5);
  EXPECT_NE(hash(back), hash(run.state));
  take_state(row.data(), back);
  EXPECT_EQ(hash(back), hash(run.state));
  EXPECT_EQ(first_difference(run.model, run.state, back), "");
  back.hands[0].turned_rad += 1e-15;
  EXPECT_NE(hash(back), hash(run.state));
  EXPECT_NE(first_difference(run.model, run.state, back).find("hand.turned_rad"), std::string::npos);
  back = run.state;
  back.rods.rods[0].velocity.at(1)[run.model.rods.rods[0].elements] += 1e-12;
  EXPECT_NE(first_difference(run.model, run.state, back).find("rod 0 (wire), velocity"), std::string::npos);

  std::vector<double> inputs(input_count(run.model));
  put_inputs(run.inputs, inputs.data());
  SessionInputs same;
  same.tools.resize(1);
  take_inputs(inputs.data(), same);
  EXPECT_EQ(same.tools[0].advance_m_s, run.inputs.tools[0].advance_m_s);
  EXPECT_EQ(same.c_arm.fluoroscopy, 1);
  const std::vector<std::string> names = input_names(run.model);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(names[0], "wire.advance_m_s");
}

TEST(Session, GoesOnFromAStateAsIfNothingHadHappened) {
  ScriptedRun run(tube_setup(), tube_vessel());
  for (int i = 0; i < 1000; ++i) run.tick();
  ScriptedRun other(tube_setup(), tube_vessel());
  std::vector<double> row(state_count(run.model));
  put_state(run.state, row.data());
  take_state(row.data(), other.state);
  restore(save(run.hands), other.hands);
  other.report = run.report;  // the operator looks at the last step
  for (int i = 0; i < 300; ++i) run.tick(), other.tick();
  EXPECT_EQ(hash(run.state), hash(other.state));
  EXPECT_EQ(save(run.hands), save(other.hands));
}

TEST(Session, DoesNotAllocateBetweenBlocks) {
  const RunSetup setup = tube_setup();
  ScriptedRun run(setup, tube_vessel());
  Recorder recorder({RecordMode::none, "", false}, run.model, setup, save(run.hands).size());
  recorder.begin(run.state, run.hands);
  const auto tick = [&] {
    run.tick();
    recorder.add(run.inputs, run.state, run.report, run.hands, run.events);
  };
  while (run.state.rods.step < 1010) tick();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the other thread has taken what it was given
  const long before = allocations();
  while (run.state.rods.step < 1490) tick();
  EXPECT_EQ(allocations(), before);
}

TEST(Session, IsTheSameAtAnySpeedAndOnAnyThread) {
  const PlayReport once = played(tube_setup());
  EXPECT_EQ(once.outcome, "success") << once.reason;
  EXPECT_EQ(played(tube_setup(), true).hash, once.hash);
  std::uint64_t one = 0, two = 0;
  std::thread a([&] { one = played(tube_setup()).hash; }), b([&] { two = played(tube_setup()).hash; });
  a.join(), b.join();
  EXPECT_EQ(one, once.hash);
  EXPECT_EQ(two, once.hash);
}

TEST(Session, SeedsVaryHandsAndRoll) {
  const std::uint64_t first = played(tube_setup(there_and_back, 1)).hash;
  EXPECT_EQ(played(tube_setup(there_and_back, 1)).hash, first);
  EXPECT_NE(played(tube_setup(there_and_back, 2)).hash, first);
}

TEST(Session, AToolWhoseDriveIsOutStaysAndTheRunSaysSo) {
  RunSetup setup = tube_setup();
  set_value("stuck", "wire", setup);
  const PlayReport report = played(setup);
  EXPECT_EQ(report.outcome, "failure");
  EXPECT_EQ(report.reason, "step 2 of 5, advance (to the bend): timed out after 5 s");
  EXPECT_EQ(to_json(setup_from_json("a file", to_json(setup))), to_json(setup));
}

TEST(Session, WhatIsSetIsUsedAndWhatIsNotThereIsRefused) {
  RunSetup setup = tube_setup();
  set_value("hand_speed", "2", setup);
  EXPECT_LT(played(setup).simulated_s, 0.6 * played(tube_setup()).simulated_s);
  set_value("wire", "bentson", setup);
  EXPECT_EQ(make_session(setup, tube_vessel()).tools[0].instrument.name, "bentson");
  set_value("friction", "0.3", setup);
  EXPECT_EQ(make_session(setup, tube_vessel()).rods.surfaces[0]->friction, 0.3);
  const RunSetup back = setup_from_json("a file", to_json(setup));
  EXPECT_EQ(to_json(back), to_json(setup));
  for (const auto& [key, value] : {std::pair{"wires", "bentson"},
                                   {"wire", "no-such"},
                                   {"friction", "x"},
                                   {"heart_rate", "300"},
                                   {"person", "1"},
                                   {"stuck", "no-such"}})
    EXPECT_THROW(set_value(key, value, setup), LoadError) << key;
}

TEST(Operator, SaysWhyItFailed) {
  const PlayReport pushed =
      played(tube_setup(with(there_and_back, "\"push_exceeds_N\": 5", "\"wall_force_exceeds_N\": 0.001")));
  EXPECT_EQ(pushed.outcome, "failure");
  EXPECT_EQ(pushed.reason, "step 2 of 5, advance (to the bend): wall_force_exceeds_N 0.001");
  const PlayReport late = played(tube_setup(with(there_and_back, "\"timeout_s\": 5", "\"timeout_s\": 0.5")));
  EXPECT_EQ(late.outcome, "failure");
  EXPECT_EQ(late.reason, "step 2 of 5, advance (to the bend): timed out after 0.5 s");
  EXPECT_NEAR(late.simulated_s, 0.5, 0.01);
  const PlayReport anyhow =
      played(tube_setup(with(there_and_back, "\"timeout_s\": 5", "\"timeout_s\": 0.5, \"otherwise\": \"go on\"")));
  EXPECT_EQ(anyhow.outcome, "success");
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

/// Gone past on the way on, in no time; gone through when a label leads to it.
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
    EXPECT_EQ(run.outcome, Outcome::success) << reason(run.plan, run.hands);
    const double fed_m = run.state.hands[0].fed_m;
    EXPECT_NEAR(fed_m, needed_mm < 10 ? 0.01 : 0.03, 0.001);
    EXPECT_EQ(begun, needed_mm < 10 ? 2 : 8);
  }
}

/// "Is this needed?": a wait whose `unless` holds at once jumps past what is not; one whose `until` comes first does
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
    EXPECT_EQ(run.outcome, Outcome::success) << reason(run.plan, run.hands);
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
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run.plan, run.hands);
  EXPECT_GT(pointed.y(), std::cos(27 * EIGEN_PI / 180)) << "the tube's far end runs along y";
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
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run.plan, run.hands);
  // A whole turn counts, so -400 degrees are not near 0; two steps late at most, of 0.4 degrees each.
  EXPECT_NEAR(run.state.hands[0].turned_rad * 180 / EIGEN_PI, -10, 0.9);
}

/// The step of a wait's end when the tip is carried to `at(step)` mm further and the hand by `hand(step)` mm.
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
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run.plan, run.hands);
  EXPECT_FALSE(run.report.tools[0].in_body);
  EXPECT_TRUE(run.report.tools[1].in_body);
  EXPECT_EQ(run.troubled, 0);
}

TEST(Operator, APlaceThatIsNotThereIsNamed) {
  const RunSetup setup = tube_setup(with(there_and_back, "\"tip_passes\": \"bend\"", "\"tip_passes\": \"bent\""));
  try {
    ScriptedRun run(setup, tube_vessel());
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("there-and-back.json:8: there is no place \"bent\""), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("bend"), std::string::npos);
  }
}

TEST(Session, ToolsInTheWrongOrderAreNamed) {
  const std::string script = with(there_and_back, "[ { \"name\": \"wire\"",
                                  "[ { \"name\": \"wire\", \"instrument\": \"cook-j\" }, { \"name\": \"guide\", "
                                  "\"instrument\": \"guide-jr4-6f\" }, { \"name\": \"other\"");
  try {
    make_session(tube_setup(script), tube_vessel());
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("wire (cook-j) goes inside guide"), std::string::npos) << error.what();
  }
}

TEST(Session, AMeshThatFacesInwardsIsTurnedAndAnEntryOutsideRefused) {
  Mesh mesh = bent_tube();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  std::string warnings;
  const MeshEntry entry = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.05, 0, 0)};
  EXPECT_EQ(vessel_of("tube", mesh, entry, warnings)->wall.triangles, bent_tube().triangles);
  EXPECT_NE(warnings.find("turned round"), std::string::npos);
  EXPECT_THROW(vessel_of("tube", mesh, {Eigen::Vector3d(0, 0.02, 0), entry.towards_P}, warnings), LoadError);
}

TEST(Session, AMeshThatIsFoldedThroughItselfIsRefused) {
  Mesh mesh = bent_tube();
  for (std::size_t v = 1; v < mesh.vertices.size(); v += 2) mesh.vertices[v].tail<2>() *= -0.5;
  std::string warnings;
  try {
    vessel_of("tube", mesh, {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.05, 0, 0)}, warnings);
    FAIL() << "accepted";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("triangles cross"), std::string::npos) << error.what();
  }
}

TEST(SettledBranch, CountsBranchesThatATipStaysIn) {
  SettledBranch tip;
  std::vector<int> came;
  std::uint64_t step = 0;
  const auto is_in = [&](int branch, int looks) {
    for (int i = 0; i < looks; ++i, step += 10)
      if (tip.comes_to(branch, step, 1e-3)) came.push_back(branch);
  };
  is_in(2, 100);
  for (int i = 0; i < 50; ++i) is_in(5, 3), is_in(2, 3);
  EXPECT_EQ(came, (std::vector<int>{2})) << "to and fro at the border is no coming";
  is_in(5, 30);
  EXPECT_EQ(came, (std::vector<int>{2})) << "29 looks after the first are 0.29 s";
  is_in(5, 1), is_in(5, 100), is_in(-1, 1), is_in(5, 31);
  EXPECT_EQ(came, (std::vector<int>{2, 5, 5})) << "out of the body it is at once";
}

/// A trunk from the access, a branch that leaves its wall at 5 mm from its axis.
TEST(Way, KnowsWhatIsBeyondWhat) {
  SphereTree tree;
  TreeBranch trunk{.name = "trunk", .spheres = {}},
      branch{.name = "branch", .parent = 0, .parent_sphere = 50, .spheres = {}};
  for (int i = 0; i <= 100; ++i) trunk.spheres.push_back({{1e-3 * i, 0, 0}, 5e-3, 1e-3 * i});
  for (int i = 0; i <= 40; ++i) branch.spheres.push_back({{0.05, 1e-3 * i, 0}, 2e-3, 1e-3 * i});
  tree.branches = {trunk, branch};
  const Way way({tree}, Eigen::Vector3d(0.1, 0, 0), {{"middle", Eigen::Vector3d(0.05, 0, 0.001)}});  // from the far end
  const int middle = way.place("middle"), twig = way.place("branch"), far = way.place("branch+20");
  EXPECT_NEAR(way.from_access_m(middle), 0.05, 1e-9);
  EXPECT_NEAR(way.from_access_m(twig), 0.055, 1e-9) << "where it leaves the trunk's wall";
  EXPECT_NEAR(way.from_access_m(far), 0.075, 1e-9);
  const auto at = [&](double x, double y) { return way.locate({x, y, 0}, 0); };
  EXPECT_FALSE(way.beyond(at(0.08, 0), middle));
  EXPECT_TRUE(way.beyond(at(0.02, 0), middle));
  EXPECT_FALSE(way.beyond(at(0.02, 0), twig));
  EXPECT_TRUE(way.beyond(at(0.05, 0.03), twig));
  EXPECT_TRUE(way.beyond(at(0.05, 0.03), far));
  EXPECT_FALSE(way.beyond(at(0.05, 0.01), far));
  EXPECT_TRUE(way.beyond(at(0.05, 0.03), middle));
  EXPECT_EQ(way.branch(at(0.05, 0.003)), 0) << "within the trunk";
  const int leaving = way.branch(far);
  EXPECT_EQ(way.astray_m(at(0.02, 0), 0), 0);
  EXPECT_EQ(way.astray_m(far, leaving), 0);
  EXPECT_EQ(way.astray_m(at(0.02, 0), leaving), -1) << "the trunk does not leave the branch";
  EXPECT_NEAR(way.astray_m(far, 0), way.from_access_m(far) - way.from_access_m(at(0.05, 0)), 1e-9);
  const Way::Departure leaves = way.departure(far, 0);
  EXPECT_NEAR(std::fabs(leaves.along.x()), 1, 1e-9);
  EXPECT_NEAR(leaves.side.y(), 1, 1e-9);
  EXPECT_TRUE(way.departure(middle, 0).side.isZero()) << "a trunk leaves nothing";
  EXPECT_EQ(way.place("trunk"), at(0.1, 0)) << "for whom comes from the access";
  for (const char* none : {"twig", "branch+", "branch+500", "branch+x", "branch-3"})
    EXPECT_EQ(way.place(none), -1) << none;
}

}  // namespace
}  // namespace ostium
