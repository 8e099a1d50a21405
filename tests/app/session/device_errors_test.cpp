/// Handling errors with balloons and stents.
#include "app/session/handling/device_errors.h"

#include <gtest/gtest.h>

#include "tests/app/session/handled_scene.h"

namespace ostium::app {
namespace {

TEST(DeviceErrors, ABalloonFollowsAWireBeyondTheGuide) {
  Played p;
  DeviceErrors errors;
  p.scene.device = balloon, p.scene.catheter = guide;
  p[guide].inserted_m = 1, p.scene.wire_tip_m = 1.05;
  p[balloon].inserted_m = 0.9;
  p.play(errors, 1, [&](int) { p.feed(balloon, 1.5e-3); });
  EXPECT_TRUE(p.events.empty()) << "to the wire's tip, 50 mm beyond the guide";
  p.play(errors, 0.04, [&](int) { p.feed(balloon, 1e-3); });
  EXPECT_TRUE(p.events.empty());
  p.play(errors, 0.2, [&](int) { p.feed(balloon, 1e-3); });
  EXPECT_EQ(p.took(data::EventCode::device_without_wire), 1);

  DeviceErrors anew;
  p.scene.wire_tip_m = 0, p[balloon].inserted_m = 0.9;
  p.play(anew, 0.1, [&](int) { p.feed(balloon, 10e-3); });
  EXPECT_TRUE(p.events.empty()) << "in the guide it needs no wire";
  p.play(anew, 0.1, [&](int) { p.feed(balloon, -10e-3); });
  p.play(anew, 0.3, [&](int) { p.feed(balloon, 10e-3); });
  EXPECT_EQ(p.took(data::EventCode::device_without_wire), 1);
}

TEST(DeviceErrors, BalloonsAreEmptyAsTheyMoveAndNotHeldForLong) {
  ScriptedRun run(tools_in_place(), vessel_in_place());
  Played p;
  DeviceErrors errors;
  const auto play = [&](double seconds, double fed_m = 0) {
    for (int i = 0; i < std::lround(seconds / 0.01); ++i) {
      p.scene.time_s += 0.01;
      p[balloon].fed_m += fed_m;
      p.scene.beyond_stent_m = beyond_stent_m(run.model, run.state);
      look_for(errors, p.map, p.scene, EventSink{0, p.events});
    }
  };
  run.state.coupling.balloons[0].tool = 1, run.state.coupling.balloons[0].balloon = 0;
  p.scene.device = balloon;
  play(5, 1e-3);
  p.scene.gauge_atm = 10, p.scene.filled = true;
  play(1, 1e-5);
  EXPECT_EQ(p.took(data::EventCode::open_balloon_dragged), 0) << "by 1 mm";
  p.scene.gauge_atm = -1;
  play(1, -4e-5);
  EXPECT_EQ(p.took(data::EventCode::open_balloon_dragged), 1) << "the gauge is down, the balloon is not empty yet";
  p.scene.filled = false;
  play(5, -1e-3);
  EXPECT_TRUE(p.events.empty());
  p.scene.gauge_atm = 10, p.scene.filled = true;
  play(59.9);
  EXPECT_TRUE(p.events.empty());
  play(0.3);
  EXPECT_EQ(p.took(data::EventCode::long_inflation), 1);

  // 12 mm of balloon in the middle of the 15 mm stent, then at its edge.
  const Plan& plan = run.model.vessel->coronaries->lesions[0];
  const double branch = run.model.physiology.flow.tree.branch("RCA"), middle = (plan.from_m + plan.to_m) / 2;
  vascular::StentState& stent = run.state.treatment.stents[0];
  const double half_stent = run.model.treatment.stents[0].length_m / 2,
               half_balloon = run.model.treatment.balloons[0].length_m / 2;
  stent.where = vascular::StentState::deployed, stent.branch = branch, stent.middle_m = middle, stent.shift_m = 0;
  run.state.coupling.balloons[0].branch = branch;
  run.state.treatment.balloons[0].pressure_Pa = 12 * 101325;
  const auto reach = [&](double beyond_m) {
    run.state.treatment.balloons[0].seat_m = middle + half_stent + beyond_m - half_balloon;
  };
  reach(1e-3);
  play(5);
  EXPECT_EQ(p.took(data::EventCode::balloon_beyond_stent), 0);
  reach(3e-3);
  play(5);
  EXPECT_EQ(p.took(data::EventCode::balloon_beyond_stent), 1);
  run.state.treatment.balloons[0].pressure_Pa = 8 * 101325;
  play(5);
  EXPECT_EQ(p.took(data::EventCode::balloon_beyond_stent), 0) << "softly";
  run.state.treatment.balloons[0].pressure_Pa = 12 * 101325;

  // In a side branch, through a cell of a stent across its mouth, it stands out of no stent.
  const vascular::FlowTree& tree = run.model.physiology.flow.tree;
  for (std::size_t side = 0; side < tree.branches.size(); ++side) {
    if (tree.branches[side].parent != static_cast<int>(branch)) continue;
    double mouth_m = plan.path.length_m();
    while (mouth_m > 0 && !same_vessel(run.model.treatment.paths[side], plan.path, mouth_m)) mouth_m -= 0.1e-3;
    if (mouth_m < 10e-3 || mouth_m + 10e-3 > plan.path.length_m()) continue;
    stent.middle_m = mouth_m + 4e-3 - half_stent;
    for (const bool aside : {true, false}) {
      run.state.coupling.balloons[0].branch = aside ? static_cast<double>(side) : branch;
      run.state.treatment.balloons[0].seat_m = mouth_m + 3e-3;
      EXPECT_NEAR(beyond_stent_m(run.model, run.state), aside ? 0 : 3e-3 + half_balloon - 4e-3, 0.2e-3)
          << tree.branches[side].name;
    }
  }
}

}  // namespace
}  // namespace ostium::app
