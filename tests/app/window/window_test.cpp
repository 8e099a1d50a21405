/// The live window without a screen: keyboard control, the rendered panel, the exchange between threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "app/session/device/box_driver.h"
#include "app/session/live/live_picture.h"
#include "app/session/live/reference.h"
#include "app/window/panel.h"
#include "core/base/units.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

TEST(Controls, KeepOrdersInOrderAndDropWhatNobodyCouldPress) {
  Controls controls;
  EXPECT_FALSE(controls.next());
  for (int i = 0; i < 100; ++i) controls.order(ConsoleCommand::change_gauge, i);
  int taken = 0;
  for (auto order = controls.next(); order; order = controls.next()) EXPECT_EQ(order->values[0], taken++);
  EXPECT_EQ(taken, 63);
}

RunSetup by_hand(RunSetup setup) {
  setup.script = free_hands(setup.script);
  return setup;
}

struct Played {
  RunSetup setup = by_hand(tube_setup(R"({ "schema": "ostium-script/1", "name": "plays", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [ { "do": "wait", "timeout_s": 100, "until": [{ "seconds": 90 }] } ] })"));
  ScriptedRun run{setup, tube_vessel()};
  LiveDriver hand{run.model, Hands::seats, 15};
  Controls& keys = hand.controls(Seat::window);
  Played() { run.take_over(&hand); }
  void steps(int n) {
    for (int i = 0; i < n; ++i) ASSERT_TRUE(run.tick());
  }
};

TEST(LiveDriver, KeysMoveTheInstrumentAndLettingGoStopsIt) {
  Played p;
  p.keys.set(ConsoleCommand::guide_feed, 1);
  p.steps(1000);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, hand_feed_m_s, 1e-4);
  p.keys.set(ConsoleCommand::fine, 1);
  p.steps(1000);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, hand_feed_m_s * (1 + fine_share), 1e-4);
  p.keys.set(ConsoleCommand::guide_feed, 0);
  p.keys.set(ConsoleCommand::guide_turn, -1);
  p.steps(500);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, hand_feed_m_s * (1 + fine_share), 1e-4);
  EXPECT_NEAR(p.run.state.hands[0].turned_rad, -0.5 * fine_share * hand_turn_rad_s, 1e-3);
}

TEST(LiveDriver, AKeyHeldForLongFeedsOnAndNothingElse) {
  Played p;
  p.keys.set(ConsoleCommand::guide_feed, 1);
  p.steps(6000);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, 6 * hand_feed_m_s, 1e-3);
  EXPECT_LE(p.run.state.rods.rods[0].inserted_m, p.run.model.tools[0].instrument.length_m);
}

TEST(LiveDriver, TheArmGoesNoFurtherThanItCan) {
  Played p;
  for (int i = 0; i < 60; ++i) p.keys.order(ConsoleCommand::turn_arm, 5);
  p.steps(2);
  EXPECT_NEAR(p.run.inputs.c_arm.lao_rad, fluoro::CArmLimits{}.lao_rad, 1e-12);
  p.keys.order(ConsoleCommand::view, 1);
  p.steps(2);
  EXPECT_LT(p.run.inputs.c_arm.lao_rad, 1.5);
  p.keys.set(ConsoleCommand::fluoroscopy, 1);
  p.steps(1000);
  EXPECT_NEAR(p.run.state.c_arm.fluoroscopy_s, 1, 2e-3);
}

TEST(LiveDriver, PauseStandsAndTheEndEnds) {
  Played p;
  p.keys.set(ConsoleCommand::guide_feed, 1);
  p.steps(100);
  p.keys.order(ConsoleCommand::pause);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    p.keys.order(ConsoleCommand::pause);
  });
  p.steps(1);  // paused until the key is pressed again
  other.join();
  EXPECT_EQ(p.run.state.rods.step, 101u);
  p.keys.order(ConsoleCommand::end);
  EXPECT_FALSE(p.run.tick());
  EXPECT_EQ(p.run.outcome, Outcome::ended) << "by the one who played";
  EXPECT_EQ(reason(p.run), "by the operator");
  EXPECT_EQ(p.run.state.rods.step, 101u);
}

TEST(LiveDriver, WhoAsksTheProgramToEndNeedNotWaitForAPausedRun) {
  Played p;
  std::atomic<bool> asked = false;
  p.hand.end_on(asked);
  p.steps(20);
  p.keys.order(ConsoleCommand::pause);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    asked = true;
  });
  EXPECT_FALSE(p.run.tick());
  other.join();
  EXPECT_EQ(p.run.outcome, Outcome::ended);
}

TEST(LiveDriver, AMarkIsAnEventOfItsStep) {
  Played p;
  const auto marked = [&] {
    return std::count_if(p.run.events.begin(), p.run.events.end(),
                         [](const OperatorEvent& e) { return e.kind == OperatorEvent::Kind::marked; });
  };
  p.steps(10);
  EXPECT_EQ(marked(), 0);
  p.keys.order(ConsoleCommand::mark);
  p.steps(1);
  EXPECT_EQ(marked(), 1);
  p.steps(1);
  EXPECT_EQ(marked(), 0);
}

/// Stands for a tracking box: its view, its pedal.
struct Box : Driver {
  Driven drive(const ScriptedRun&, SessionInputs& inputs) override {
    inputs.c_arm.lao_rad = lao_rad, inputs.c_arm.fluoroscopy = pedal, inputs.c_arm.cine = false;
    inputs.tools[0] = {0.01, 0};
    return Driven::on;
  }
  double lao_rad = 0.1;
  bool pedal = false;
};

TEST(LiveDriver, AtTheBoxTheConsoleIsEverybodysAndTheInstrumentsAreNot) {
  RunSetup setup = Played().setup;
  ScriptedRun run(setup, tube_vessel());
  Box box;
  LiveDriver hand(run.model, Hands::box, 15, &box);
  run.take_over(&hand);
  Controls &keys = hand.controls(Seat::window), &browser = hand.controls(Seat::browser);
  const auto step = [&] { ASSERT_TRUE(run.tick()); };
  step();
  const Eigen::Vector3d before = run.inputs.c_arm.p_PI;
  EXPECT_EQ(run.inputs.c_arm.lao_rad, 0.1);
  keys.order({ConsoleCommand::move_table, {10, -20, 0}});
  browser.order(ConsoleCommand::turn_arm, 5);
  keys.set(ConsoleCommand::guide_feed, -1);
  step();
  EXPECT_NEAR((run.inputs.c_arm.p_PI - before - Eigen::Vector3d(0.01, -0.02, 0)).norm(), 0, 1e-12) << "the table";
  EXPECT_NEAR(run.inputs.c_arm.lao_rad, 0.1 + 5 * units::degree, 1e-12) << "from where the box had it";
  EXPECT_EQ(run.inputs.tools[0].feed_m_s, 0.01) << "the hand at the box";
  box.lao_rad = 0.3, box.pedal = true;
  step();
  EXPECT_EQ(run.inputs.c_arm.lao_rad, 0.3) << "whoever asks last has the say";
  EXPECT_TRUE(run.inputs.c_arm.fluoroscopy);
  EXPECT_NEAR(run.inputs.c_arm.p_PI.x(), before.x() + 0.01, 1e-12) << "the table stays";
  box.pedal = false;
  browser.set(ConsoleCommand::cine, 1);
  step();
  EXPECT_FALSE(run.inputs.c_arm.fluoroscopy);
  EXPECT_TRUE(run.inputs.c_arm.cine) << "anybody's pedal";
}

TEST(LiveDriver, TheScriptWaitsForWhoTakesOverAndBeginsItsStepAnew) {
  const RunSetup setup = tube_setup(R"({ "schema": "ostium-script/1", "name": "waits", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [ { "do": "advance", "tool": "wire", "speed_mm_s": 10, "timeout_s": 2, "until": [{ "inserted_mm": 15 }] } ] })");
  ScriptedRun run(setup, tube_vessel());
  LiveDriver hand(run.model, Hands::script, 15);
  run.take_over(&hand);
  Controls& keys = hand.controls(Seat::browser);
  const auto steps = [&](int n) {
    for (int i = 0; i < n; ++i) ASSERT_TRUE(run.tick());
  };
  steps(1000);
  EXPECT_NEAR(run.state.hands[0].fed_m, 0.010, 2e-4);
  keys.order(ConsoleCommand::take_over);
  steps(3000);
  EXPECT_NEAR(run.state.hands[0].fed_m, 0.010, 2e-4) << "nobody moves it";
  EXPECT_EQ(run.outcome, Outcome::running) << "its time is over, and does not count";
  keys.order(ConsoleCommand::hand_back);
  steps(400);
  EXPECT_NEAR(run.state.hands[0].fed_m, 0.014, 3e-4);
  while (run.tick()) {
  }
  EXPECT_EQ(run.outcome, Outcome::success);
}

TEST(Panel, TheReferenceIsTheFullestOfTheLastCineUntilSomebodyChooses) {
  Reference reference;
  const auto shade = [](int grey) {
    fluoro::Picture p;
    p.width = p.height = 1;
    p.grey.assign(1, static_cast<std::uint8_t>(grey));
    return p;
  };
  const auto shown = [&] { return reference.picture() ? reference.picture()->grey[0] : -1; };
  reference.take(shade(1), false, 0.9, 1);
  EXPECT_EQ(shown(), -1) << "fluoroscopy";
  for (const int k : {10, 11, 12, 13}) reference.take(shade(k), true, k == 12 ? 0.8 : 0.2, k);
  EXPECT_EQ(shown(), -1) << "it goes on";
  reference.take(shade(2), false, 0, 14);
  EXPECT_EQ(shown(), 12);
  reference.take(shade(20), true, NAN, 20), reference.take(shade(21), true, 0.1, 21),
      reference.take(shade(2), false, 0, 22);
  EXPECT_EQ(shown(), 12) << "a run in which no contrast could be seen";
  reference.take(shade(30), true, 0.2, 30), reference.take(shade(2), false, 0, 31);
  EXPECT_EQ(shown(), 30) << "the last run, however full the one before";
  reference.freeze(shade(40), 40);
  reference.take(shade(50), true, 0.9, 50), reference.take(shade(2), false, 0, 51);
  EXPECT_EQ(shown(), 40);
  reference.forget_after(45);
  EXPECT_EQ(shown(), 40) << "of before";
  reference.forget_after(35);
  EXPECT_EQ(shown(), -1) << "of a time that is given up";
  reference.take(shade(60), true, 0.9, 36), reference.take(shade(2), false, 0, 37);
  EXPECT_EQ(shown(), 60);
}

/// Any picture of a film that nobody exposes is black or the one before.
TEST(LivePicture, FollowsThePedalsWhoeverPressesThem) {
  for (const ConsoleCommand pedal : {ConsoleCommand::fluoroscopy, ConsoleCommand::cine}) {
    Played p;
    LivePicture live(p.run.model, {.filmed = nullptr, .has_pedals = true, .pixels = 64});
    const auto look = [&] {
      p.steps(70);
      ASSERT_TRUE(p.hand.snapshots(Seat::window).update());
      live.look(p.hand.snapshots(Seat::window).front(), true);
    };
    look();
    EXPECT_TRUE(live.picture().grey.empty()) << "no pedal has been pressed";
    p.keys.set(pedal, 1);
    look();
    ASSERT_FALSE(live.picture().grey.empty()) << "a pedal alone";
    const std::vector<std::uint8_t> last = live.picture().grey;
    EXPECT_GT(*std::max_element(last.begin(), last.end()), 0);
    EXPECT_EQ(live.cine(), pedal == ConsoleCommand::cine);
    p.keys.set(pedal, 0);
    p.keys.set(ConsoleCommand::guide_feed, 1);
    look();
    const std::vector<std::uint8_t>& now = live.picture().grey;
    ASSERT_EQ(now.size(), last.size());
    std::size_t others = 0;
    for (std::size_t i = 0; i < last.size(); ++i) others += now[i] != last[i];
    EXPECT_GT(others, 0u) << "the sign of radiation goes out";
    EXPECT_LT(others, last.size() / 6) << "last image hold";
    p.hand.restart(p.run);
    ASSERT_TRUE(p.hand.snapshots(Seat::window).update());
    live.look(p.hand.snapshots(Seat::window).front(), true);
    EXPECT_TRUE(live.picture().grey.empty()) << "the run has gone back: that image is of a time given up";
  }
}

TEST(LivePicture, AStoredCineOfATimeThatIsGivenUpIsGone) {
  Played p;
  LivePicture live(p.run.model, {.filmed = nullptr, .has_pedals = true, .pixels = 64});
  const auto look = [&] {
    ASSERT_TRUE(p.hand.snapshots(Seat::window).update());
    live.look(p.hand.snapshots(Seat::window).front(), true);
  };
  const auto film = [&](bool down) {
    p.keys.set(ConsoleCommand::cine, down);
    p.steps(70), look();
  };
  film(true), film(false);
  p.keys.order(ConsoleCommand::review, 1);
  p.steps(70), look();
  EXPECT_EQ(live.review_frames(), 1);
  const SessionState then = p.run.state;
  film(true), film(true), film(false);
  EXPECT_EQ(live.review_frames(), 2);
  p.run.state = then;
  p.hand.restart(p.run);
  look();
  EXPECT_EQ(live.review_frames(), 0) << "live again";
  p.keys.order(ConsoleCommand::review, 1);
  p.keys.order(ConsoleCommand::pause);
  p.steps(70), look();
  EXPECT_EQ(live.review_frames(), 1) << "of the film before";
}

TEST(Panel, ShowsPictureToolsAndWhatIsWrong) {
  Played p;
  p.keys.set(ConsoleCommand::guide_feed, 1);
  p.steps(400);
  ASSERT_TRUE(p.hand.snapshots(Seat::window).update());
  const PanelTexts texts = panel_texts(p.run.model, p.run.plan, p.hand);
  fluoro::Picture grey;
  grey.width = grey.height = 64;
  grey.grey.assign(64 * 64, 200);
  std::vector<std::uint32_t> calm, red;
  PanelView view{.picture = &grey,
                 .reference = nullptr,
                 .dose = {},
                 .review_frame = 0,
                 .review_frames = 0,
                 .problem = "",
                 .help = false};
  draw_panel(texts, p.hand.snapshots(Seat::window).front(), view, calm);
  const auto at = [](const std::vector<std::uint32_t>& pixels, int x, int y) {
    return pixels[static_cast<std::size_t>(y * panel_width + x)] & 0xffffffu;
  };
  EXPECT_EQ(at(calm, 300, 200), 0xc8c8c8u) << "the picture";
  view.problem = "wire lost";
  draw_panel(texts, p.hand.snapshots(Seat::window).front(), view, red);
  EXPECT_GT(at(red, 700, 380) >> 16, 2 * (at(red, 700, 380) & 0xffu)) << "a red bar";
  EXPECT_NE(calm, red);
}

TEST(Panel, ShowsThatAMarkIsSetForAWhile) {
  Played p;
  const PanelTexts texts = panel_texts(p.run.model, p.run.plan, p.hand);
  const PanelView view;
  // Where a mark is told, which nothing else is: beside the same run without one.
  const auto shown = [&] {
    p.hand.snapshots(Seat::window).update();
    std::vector<std::uint32_t> pixels;
    draw_panel(texts, p.hand.snapshots(Seat::window).front(), view, pixels);
    long bright = 0;
    for (int y = 44; y < 64; ++y)
      for (int x = 16; x < 200; ++x)
        bright += (pixels[static_cast<std::size_t>(y * panel_width + x)] & 0xff00u) > 0x8000u;
    return bright;
  };
  p.steps(200);
  EXPECT_EQ(shown(), 0);
  p.keys.order(ConsoleCommand::mark);
  p.steps(100);
  EXPECT_GT(shown(), 50);
  const Snapshot& now = p.hand.snapshots(Seat::window).front();
  EXPECT_EQ(now.marks, 1);
  EXPECT_NEAR(now.marked_s, 0.2, 2e-3);
  p.steps(2100);
  EXPECT_EQ(shown(), 0) << "two seconds later";
}

}  // namespace
}  // namespace ostium::app
