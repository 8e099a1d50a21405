/// The live window without a screen: keyboard control, the rendered panel, the exchange between threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "app/session/device/box_driver.h"
#include "app/window/live_picture.h"
#include "app/window/panel.h"
#include "app/window/reference.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

TEST(Controls, KeepActionsInOrderAndDropWhatNobodyCouldPress) {
  Controls controls;
  EXPECT_FALSE(controls.next());
  for (int i = 0; i < 100; ++i) controls.press(i % 2 ? Action::atm_up : Action::swap);
  int taken = 0;
  for (auto action = controls.next(); action; action = controls.next())
    EXPECT_EQ(*action, taken++ % 2 ? Action::atm_up : Action::swap);
  EXPECT_EQ(taken, 63);
}

RunSetup by_hand(RunSetup setup) {
  setup.script = free_hands(setup.script);
  return setup;
}

struct Played {
  RunSetup setup = by_hand(tube_setup(R"({ "schema": "ostium-script/1", "name": "plays", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [ { "do": "wait", "timeout_s": 100, "until": [{ "seconds": 90, "of": "wire" }] } ] })"));
  ScriptedRun run{setup, tube_vessel()};
  LiveDriver hand{run.model, true, 15};
  Played() { run.take_over(&hand); }
  void steps(int n) {
    for (int i = 0; i < n; ++i) ASSERT_TRUE(run.tick());
  }
};

TEST(LiveDriver, KeysMoveTheInstrumentAndLettingGoStopsIt) {
  Played p;
  p.hand.controls.set(Level::guide_feed, 1);
  p.steps(1000);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, hand_feed_m_s, 1e-4);
  p.hand.controls.set(Level::fine, 1);
  p.steps(1000);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, hand_feed_m_s * (1 + fine_share), 1e-4);
  p.hand.controls.set(Level::guide_feed, 0);
  p.hand.controls.set(Level::guide_turn, -1);
  p.steps(500);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, hand_feed_m_s * (1 + fine_share), 1e-4);
  EXPECT_NEAR(p.run.state.hands[0].turned_rad, -0.5 * fine_share * hand_turn_rad_s, 1e-3);
}

TEST(LiveDriver, AKeyHeldForLongFeedsOnAndNothingElse) {
  Played p;
  p.hand.controls.set(Level::guide_feed, 1);
  p.steps(6000);
  EXPECT_NEAR(p.run.state.hands[0].fed_m, 6 * hand_feed_m_s, 1e-3);
  EXPECT_LE(p.run.state.rods.rods[0].inserted_m, p.run.model.tools[0].instrument.length_m);
}

TEST(LiveDriver, TheArmGoesNoFurtherThanItCan) {
  Played p;
  for (int i = 0; i < 60; ++i) p.hand.controls.press(Action::left);
  p.steps(2);
  EXPECT_NEAR(p.run.inputs.c_arm.lao_rad, fluoro::CArmLimits{}.lao_rad, 1e-12);
  p.hand.controls.press(Action::view_1);
  p.steps(2);
  EXPECT_LT(p.run.inputs.c_arm.lao_rad, 1.5);
  p.hand.controls.set(Level::fluoroscopy, 1);
  p.steps(1000);
  EXPECT_NEAR(p.run.state.c_arm.fluoroscopy_s, 1, 2e-3);
}

TEST(LiveDriver, PauseStandsAndTheEndEnds) {
  Played p;
  p.hand.controls.set(Level::guide_feed, 1);
  p.steps(100);
  p.hand.controls.press(Action::pause);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    p.hand.controls.press(Action::pause);
  });
  p.steps(1);  // paused until the key is pressed again
  other.join();
  EXPECT_EQ(p.run.state.rods.step, 101u);
  p.hand.controls.press(Action::quit);
  EXPECT_FALSE(p.run.tick());
  EXPECT_EQ(p.run.outcome, Outcome::ended) << "by the one who played";
  EXPECT_EQ(reason(p.run.plan, p.run.hands), "");
  EXPECT_EQ(p.run.state.rods.step, 101u);
}

TEST(LiveDriver, AMarkIsAnEventOfItsStep) {
  Played p;
  const auto marked = [&] {
    return std::count_if(p.run.events.begin(), p.run.events.end(),
                         [](const OperatorEvent& e) { return e.kind == OperatorEvent::Kind::marked; });
  };
  p.steps(10);
  EXPECT_EQ(marked(), 0);
  p.hand.controls.press(Action::mark);
  p.steps(1);
  EXPECT_EQ(marked(), 1);
  p.steps(1);
  EXPECT_EQ(marked(), 0);
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
  reference.take(shade(1), false, 0.9);
  EXPECT_EQ(shown(), -1) << "fluoroscopy";
  for (const int k : {10, 11, 12, 13}) reference.take(shade(k), true, k == 12 ? 0.8 : 0.2);
  EXPECT_EQ(shown(), -1) << "it goes on";
  reference.take(shade(2), false, 0);
  EXPECT_EQ(shown(), 12);
  reference.take(shade(20), true, NAN), reference.take(shade(21), true, 0.1), reference.take(shade(2), false, 0);
  EXPECT_EQ(shown(), 12) << "a run in which no contrast could be seen";
  reference.take(shade(30), true, 0.2), reference.take(shade(2), false, 0);
  EXPECT_EQ(shown(), 30) << "the last run, however full the one before";
  reference.freeze(shade(40));
  reference.take(shade(50), true, 0.9), reference.take(shade(2), false, 0);
  EXPECT_EQ(shown(), 40);
}

/// Any picture of a film that nobody exposes is black or the one before.
TEST(LivePicture, FollowsThePedalsWhoeverPressesThem) {
  for (const Level pedal : {Level::fluoroscopy, Level::cine}) {
    Played p;
    LivePicture live(p.run.model, {.filmed = nullptr, .has_pedals = true, .frames_per_s = 15, .pixels = 64});
    const auto look = [&] {
      p.steps(70);
      ASSERT_TRUE(p.hand.snapshots().update());
      live.look(p.hand.snapshots().front(), true);
    };
    look();
    EXPECT_TRUE(live.picture().grey.empty()) << "no pedal has been pressed";
    p.hand.controls.set(pedal, 1);
    look();
    ASSERT_FALSE(live.picture().grey.empty()) << "a pedal alone";
    const std::vector<std::uint8_t> last = live.picture().grey;
    EXPECT_GT(*std::max_element(last.begin(), last.end()), 0);
    EXPECT_EQ(live.cine(), pedal == Level::cine);
    p.hand.controls.set(pedal, 0);
    p.hand.controls.set(Level::guide_feed, 1);
    look();
    EXPECT_EQ(live.picture().grey, last) << "last image hold";
  }
}

TEST(Panel, ShowsPictureToolsAndWhatIsWrong) {
  Played p;
  p.hand.controls.set(Level::guide_feed, 1);
  p.steps(400);
  ASSERT_TRUE(p.hand.snapshots().update());
  const PanelTexts texts = panel_texts(p.run.model, p.run.plan, p.hand, true);
  fluoro::Picture grey;
  grey.width = grey.height = 64;
  grey.grey.assign(64 * 64, 200);
  std::vector<std::uint32_t> calm, red;
  PanelView view{.picture = &grey, .reference = nullptr, .dose = {}, .problem = "", .help = false};
  draw_panel(texts, p.hand.snapshots().front(), view, calm);
  const auto at = [](const std::vector<std::uint32_t>& pixels, int x, int y) {
    return pixels[static_cast<std::size_t>(y * panel_width + x)] & 0xffffffu;
  };
  EXPECT_EQ(at(calm, 300, 200), 0xc8c8c8u) << "the picture";
  view.problem = "wire lost";
  draw_panel(texts, p.hand.snapshots().front(), view, red);
  EXPECT_GT(at(red, 700, 380) >> 16, 2 * (at(red, 700, 380) & 0xffu)) << "a red bar";
  EXPECT_NE(calm, red);
}

}  // namespace
}  // namespace ostium::app
