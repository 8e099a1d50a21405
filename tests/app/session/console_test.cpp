/// The console of a played run: the tool in hand, the indeflator, and what is left of both after going back.
#include "app/session/live/console.h"

#include <gtest/gtest.h>

#include "app/session/device/box_driver.h"
#include "app/session/live/live_driver.h"
#include "app/session/run/branch.h"
#include "core/base/units.h"
#include "tests/app/session/recorded.h"
#include "tests/app/session/short_treatment.h"

namespace ostium::app {
namespace {

using data::ConsoleCommand;
using units::atm;

constexpr int the_balloon = 1, the_stent = 2;  // of the short treatment's tools

RunSetup played_by_hand() {
  RunSetup out = setup();
  out.script = free_hands(out.script);
  return out;
}

TEST(Console, AToolThatIsInTheWayDoesNotEndAPlayedRun) {
  ScriptedRun run(played_by_hand(), vessel());
  LiveDriver hand(run.model, Hands::seats, 15);
  run.take_over(&hand);
  Controls& keys = hand.controls(Seat::browser);
  keys.set(ConsoleCommand::device_feed, 1);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(run.tick());
  ASSERT_TRUE(run.report.tools[the_balloon].in_body);
  keys.order(ConsoleCommand::next_device);
  bool refused = false;
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(run.tick()) << "the run has ended";
    refused |= run.report.refused == the_stent && run.report.in_its_way == the_balloon;
  }
  EXPECT_TRUE(refused);
  EXPECT_EQ(run.state.hands[the_stent].fed_m, 0);
}

TEST(Console, APlungerDrawnBackDoesNotFillTheBalloonAgain) {
  const ScriptedRun run(played_by_hand(), vessel());
  Console console(run.model);
  const auto gauge_atm = [&] {
    SessionInputs inputs = run.inputs;
    console.fill(run.model, Hands::seats, inputs);
    return inputs.delivery.gauge_Pa / atm;
  };
  console.take(run.model, {ConsoleCommand::change_gauge, {10}}, Hands::seats);
  EXPECT_NEAR(gauge_atm(), 10, 1e-9);
  console.controls[0].set(ConsoleCommand::vacuum, 1);
  EXPECT_NEAR(gauge_atm(), -0.9, 1e-9);
  console.controls[0].set(ConsoleCommand::vacuum, 0);
  EXPECT_EQ(gauge_atm(), 0) << "let go of";
  console.take(run.model, {ConsoleCommand::change_gauge, {1}}, Hands::seats);
  EXPECT_NEAR(gauge_atm(), 1, 1e-9);
  const auto second_atm = [&] {
    SessionInputs inputs = run.inputs;
    console.fill(run.model, Hands::seats, inputs);
    return inputs.delivery.second_gauge_Pa / atm;
  };
  console.take(run.model, {ConsoleCommand::second_gauge, {8}}, Hands::seats);
  console.take(run.model, {ConsoleCommand::change_second_gauge, {2}}, Hands::seats);
  EXPECT_NEAR(second_atm(), 10, 1e-9);
  EXPECT_NEAR(gauge_atm(), 1, 1e-9) << "each has its own";
  console.controls[0].set(ConsoleCommand::vacuum, 1);
  EXPECT_NEAR(second_atm(), -0.9, 1e-9) << "both are emptied together";
}

TEST(Console, AfterGoingBackTheToolThatWasMovedLastIsInHand) {
  const ScriptedRun run(played_by_hand(), vessel());
  Console console(run.model);
  const CArmInputs arm;
  console.take(run.model, {ConsoleCommand::next_device}, Hands::seats);
  ASSERT_EQ(console.right_hand(), the_stent);
  console.restart(run.inputs, arm, {900, 500, 0, 400});
  EXPECT_EQ(console.right_hand(), the_balloon) << "the guide is in the other hand";
  console.restart(run.inputs, arm, {900, 500, 0, 600});
  EXPECT_EQ(console.right_hand(), 3);
  console.restart(run.inputs, arm, {900, 0, 0, 0});
  EXPECT_EQ(console.right_hand(), the_balloon) << "as at first";
}

TEST(Console, WhenAToolWasMovedIsKnownFromTheRecording) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::full);
  ScriptedRun run(tube_setup(), tube_vessel());
  go_back(run, {folder("run.h5"), 1000});
  EXPECT_EQ(run.moved_at.at(0), 1000u) << "it is fed all the time";
  go_back(run, {folder("run.h5"), 0});
  EXPECT_EQ(run.moved_at.at(0), 0u);
}

}  // namespace
}  // namespace ostium::app
