/// A session's lists of fields, and bit-identical results however a run is executed.
#include "app/session/model/session.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "app/session/run/play.h"
#include "tests/app/session/played.h"
#include "tests/app/session/tube_vessel.h"
#include "tests/support/allocations.h"

namespace ostium::app {
namespace {

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
  EXPECT_NE(first_difference(run.model, run.state, back).find("hands[0].turned_rad"), std::string::npos);
  back = run.state;
  back.rods.rods[0].velocity.at(1)[run.model.rods.rods[0].elements] += 1e-12;
  EXPECT_NE(first_difference(run.model, run.state, back).find("rod 0 (wire), velocity"), std::string::npos);

  std::vector<double> inputs(input_count(run.model));
  put_inputs(run.inputs, inputs.data());
  SessionInputs same;
  same.tools.resize(1);
  take_inputs(inputs.data(), same);
  EXPECT_EQ(same.tools[0].feed_m_s, run.inputs.tools[0].feed_m_s);
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
  other.report = run.report;  // the operator uses the last step's report
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
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // gives the other thread time to take the block
  const long before = allocations();
  while (run.state.rods.step < 1190) tick();
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
  EXPECT_EQ(
      report.reason,
      "step 2 of 5, advance (to the bend): timed out after 5 s, waiting for tip_passes bend (wire is out of the body)");
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
    EXPECT_THROW(set_value(key, value, setup), data::LoadError) << key;
}

TEST(Session, ToolsInTheWrongOrderAreNamed) {
  const std::string script = with(there_and_back, "[ { \"name\": \"wire\"",
                                  "[ { \"name\": \"wire\", \"instrument\": \"cook-j\" }, { \"name\": \"guide\", "
                                  "\"instrument\": \"guide-jr4-6f\" }, { \"name\": \"other\"");
  try {
    make_session(tube_setup(script), tube_vessel());
    FAIL();
  } catch (const data::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("wire (cook-j) goes inside guide"), std::string::npos) << error.what();
  }
}

TEST(Session, AMeshThatFacesInwardsIsTurnedAndAnEntryOutsideRefused) {
  vascular::Mesh mesh = bent_tube();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  std::string warnings;
  const MeshEntry entry = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.05, 0, 0)};
  EXPECT_EQ(vessel_of("tube", mesh, entry, warnings)->wall.triangles, bent_tube().triangles);
  EXPECT_NE(warnings.find("turned round"), std::string::npos);
  EXPECT_THROW(vessel_of("tube", mesh, {Eigen::Vector3d(0, 0.02, 0), entry.towards_P}, warnings), data::LoadError);
}

TEST(Session, AnEntryLeadsOnInItsOwnPiece) {
  vascular::Mesh mesh = bent_tube(), other = bent_tube();
  for (Eigen::Vector3d& p : other.vertices) p.z() += 0.2;
  append(mesh, other);
  std::string warnings;
  EXPECT_NO_THROW(vessel_of("tubes", mesh, {Eigen::Vector3d::Zero(), {0.02, 0, 0}}, warnings));
  EXPECT_THROW(vessel_of("tubes", mesh, {Eigen::Vector3d::Zero(), {0.02, 0, 0.2}}, warnings), data::LoadError);
}

TEST(Session, AMeshThatIsFoldedThroughItselfIsRefused) {
  vascular::Mesh mesh = bent_tube();
  for (std::size_t v = 1; v < mesh.vertices.size(); v += 2) mesh.vertices[v].tail<2>() *= -0.5;
  std::string warnings;
  try {
    vessel_of("tube", mesh, {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.05, 0, 0)}, warnings);
    FAIL() << "accepted";
  } catch (const data::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("triangles cross"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ostium::app
