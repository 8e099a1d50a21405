/// Arteries that give way to instruments in a session: they do, everything that shows them shows it, instruments stay
/// inside, a recording replays; rigid ones are what they were.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "app/session/labelling/labels.h"
#include "app/session/model/penetration.h"
#include "app/session/run/play.h"
#include "app/session/run/replay.h"
#include "app/session/scene/film.h"
#include "data/formats/load_error.h"

namespace ostium::app {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

const char* const a_balloon = R"({
  "schema": "ostium-script/1", "name": "a-balloon", "title": "A test",
  "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" },
             { "name": "balloon", "instrument": "balloon-25x15" },
             { "name": "wire", "instrument": "wire-014-workhorse" } ],
  "steps": [
    { "do": "advance", "tool": "guide", "speed_mm_s": 15, "until": [{ "inserted_mm": 17 }], "timeout_s": 3 },
    { "do": "advance", "tool": "wire", "speed_mm_s": 40, "turn_deg_s": 90, "until": [{ "inserted_mm": 80 }],
      "timeout_s": 4 },
    { "do": "advance", "tool": "balloon", "speed_mm_s": 30, "until": [{ "inserted_mm": 60 }], "timeout_s": 4 },
    { "do": "inflate", "gauge_atm": 10, "over_s": 3 },
    { "do": "wait", "until": [{ "seconds": 3 }] },
    { "do": "wait", "until": [{ "seconds": 0.5 }] }
  ]
})";

RunSetup setup_with(const char* arteries) {
  RunSetup out;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, out);
  set_script(data::read_script("a-balloon.json", a_balloon), out);
  set_value("begin", "RCA", out);
  if (*arteries) set_value("arteries", arteries, out);
  return out;
}

std::shared_ptr<const Vessel> vessel() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(setup_with(""), warnings);
  }();
  return made;
}

double most_m(const std::vector<Vector3d>& aside) {
  double most = 0;
  for (const Vector3d& p : aside) most = std::max(most, p.norm());
  return most;
}

TEST(YieldingArteries, GiveWayAndTheRecordingReplays) {
  const fs::path folder = fs::temp_directory_path() / ("ostium-yields-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string file = (folder / "run.h5").string();
  PlayOptions options;
  options.recorder = {RecordMode::full, file, true};
  ScriptedRun run(setup_with("yield"), vessel());
  const PlayReport report = play(run, setup_with("yield"), options);
  EXPECT_EQ(report.outcome, "success") << report.reason;
  EXPECT_EQ(report.penetration.outside, 0);
  EXPECT_LT(report.penetration.deepest_m, 0.05e-3);
  EXPECT_GT(most_m(run.state.wall_aside_P), 0.3e-3) << "an inflated balloon straightens";
  EXPECT_LT(most_m(run.state.wall_aside_P), 3e-3);

  Replay replay(file, vessel());
  EXPECT_TRUE(replay.setup.arteries_yield);
  EXPECT_FALSE(verify(replay).first_step);
  EXPECT_EQ(hash(replay.state), report.hash);
  const std::vector<std::string> columns = replay.recording.signal_columns();
  ASSERT_EQ(columns.back(), "artery_aside_mm");
  const std::vector<double> signals = replay.recording.signals();
  EXPECT_NEAR(signals.back(), 1e3 * most_m(run.state.wall_aside_P), 0.1);
  fs::remove_all(folder);
}

TEST(YieldingArteries, AScratchHoldsNothingThatIsNeeded) {
  ScriptedRun a(setup_with("yield"), vessel()), b(setup_with("yield"), vessel());
  for (int n = 0; n < 6000; ++n) {
    if (n % 1500 == 1499) {
      SessionScratch fresh(b.model);
      SessionReport report;
      SessionState state = b.state, same = a.state;
      SessionScratch other(a.model);
      step(a.model, a.inputs, same, other, report);
      step(b.model, b.inputs, state, fresh, report);
      EXPECT_EQ(first_difference(a.model, same, state), "") << n;
    }
    a.tick(), b.tick();
  }
  EXPECT_EQ(hash(a.state), hash(b.state));
  EXPECT_GT(most_m(a.state.wall_aside_P), 0.02e-3);
}

TEST(YieldingArteries, WhatShowsThemShowsIt) {
  const SessionModel model = make_session(setup_with("yield"), vessel());
  SessionState state = make_state(model, 0);
  const std::vector<vascular::FlowCell>& cells = model.physiology.flow.tree.cells;
  ASSERT_EQ(state.wall_aside_P.size(), cells.size());
  const Coronaries& c = *model.vessel->coronaries;
  const vascular::LumenMoment before{.phase = state.blood.heart.phase};
  const std::size_t cell = static_cast<std::size_t>(model.treatment.paths.back().cells.back());
  const Vector3d by(0.3e-3, -0.2e-3, 0.1e-3), centre = c.map.centre(cell, before);
  std::vector<Vector3d> shape_before, shape_after;
  c.shape->at(state.blood.radius_m, before, shape_before);
  for (Vector3d& aside : state.wall_aside_P) aside = by;
  EXPECT_LT((c.map.centre(cell, moment(model, state)) - centre - by).norm(), 1e-12);
  c.shape->at(state.blood.radius_m, moment(model, state), shape_after);
  int moved = 0;
  for (std::size_t v = 0; v < shape_after.size(); ++v) {
    const Vector3d off = shape_after[v] - shape_before[v];
    const bool coronary = c.map.sources[v].first.part == vascular::VertexSource::coronary;
    EXPECT_LE((off.cross(by)).norm(), 1e-12) << "along it, by a share where the aorta begins";
    moved += coronary && (off - by).norm() < 1e-12;
    const Vector3d wall = wall_vertex(*model.vessel, state.wall_m, static_cast<int>(v), moment(model, state)) -
                          wall_vertex(*model.vessel, state.wall_m, static_cast<int>(v), before);
    EXPECT_LT((wall - off).norm(), 1e-12);
  }
  EXPECT_GT(moved, 1000);
}

TEST(YieldingArteries, ALabelsCentrelineGoesAlong) {
  const SessionModel model = make_session(setup_with("yield"), vessel());
  SessionState state = make_state(model, 0);
  const Labeller labeller(model);
  const fluoro::View view;
  const auto line_of_RCA = [&] {
    for (LabelledThing& thing : labeller.at(state, view).things)
      if (thing.name == "RCA") return thing.line_P;
    return Eigen::Matrix3Xd(3, 0);
  };
  const Eigen::Matrix3Xd before = line_of_RCA();
  ASSERT_GT(before.cols(), 20);
  const Vector3d by(0.3e-3, -0.2e-3, 0.1e-3);
  for (Vector3d& aside : state.wall_aside_P) aside = by;
  const Eigen::Matrix3Xd after = line_of_RCA();
  for (Eigen::Index i = 0; i < before.cols(); ++i) EXPECT_LT((after.col(i) - before.col(i) - by).norm(), 1e-12);
}

TEST(YieldingArteries, RigidOnesAreTheRunThatTheyWere) {
  const auto hash_of = [](const char* arteries) {
    ScriptedRun run(setup_with(arteries), vessel());
    while (run.state.rods.step < 3000 && run.tick()) {
    }
    return hash(run.state);
  };
  EXPECT_EQ(hash_of("rigid"), hash_of(""));
  EXPECT_NE(hash_of("yield"), hash_of(""));
  RunSetup setup = setup_with("");
  EXPECT_THROW(set_value("arteries", "soft", setup), data::LoadError);
}

}  // namespace
}  // namespace ostium::app
