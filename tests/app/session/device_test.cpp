/// Hands at a tracking box drive a session: instrument positions, pauses, recording.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "app/session/device/box_run.h"
#include "app/session/device/emulated_box_driver.h"
#include "app/session/run/play.h"
#include "app/session/run/replay.h"
#include "core/base/units.h"
#include "device/emulator/emulated_port.h"
#include "tests/app/session/tube_vessel.h"
#include "tests/support/allocations.h"

namespace ostium::app {
namespace {

/// A wire in the tube, and a box whose station 1 sees it; the test moves it.
struct AtTheBox {
  explicit AtTheBox(int delay = 1, std::optional<double> friction = {}, const char* script = there_and_back)
      : port{box, [this](device::EmulatedBox& b) { move(b); }, delay},
        run{setup(friction, script), tube_vessel(), &hand} {
    box.station[0] = {device::Tool::wire, 200, 0, 0};
  }

  static device::Calibration calibration() {
    device::Calibration c;
    c.track[0].before_introducer_mm = 10;
    return c;
  }
  static RunSetup setup(std::optional<double> friction, const char* script) {
    RunSetup s = tube_setup(script);
    s.friction = friction;
    s.script = free_hands(s.script);
    return s;
  }

  device::EmulatedBox box{calibration()};
  double mm_s = 0, deg_s = 0;
  std::function<void(device::EmulatedBox&)> moves;  ///< used instead of these two
  device::EmulatedPort port;
  void move(device::EmulatedBox& b) {
    if (moves) return moves(b);
    b.station[0].advanced_mm += 1e-3 * mm_s, b.station[0].turned_deg += 1e-3 * deg_s;
    if (when_paused && host.now().pause != device::Pause::none) when_paused(b);
  }
  std::function<void(device::EmulatedBox&)> when_paused;
  device::TrackingBox host{port, {}};
  std::atomic<bool> stop{false};
  BoxDriver hand{[] {
                   BoxDriverSettings s;
                   s.views = {{0.7, 0}, {-0.5, 0.4}};
                   return s;
                 }(),
                 [this](const device::BoxRequest& request) -> const device::BoxSnapshot& {
                   host.poll(0, request);
                   return host.now();
                 },
                 &stop};
  ScriptedRun run;

  void ticks(int n) {
    for (int i = 0; i < n; ++i) ASSERT_TRUE(run.tick());
  }
  double inserted_mm() const { return 1e3 * run.state.rods.rods[0].inserted_m; }
  double turned_deg() const { return run.state.hands[0].turned_rad * 180 / units::pi; }
};

TEST(Device, PeopleDoTheRestAndGiveTheHeparinThemselves) {
  for (const data::ScriptStep& step : free_hands(data::find_script("rca-from-the-ostium")).steps)
    EXPECT_TRUE(step.action == data::ScriptAction::view || step.action == data::ScriptAction::fluoroscopy ||
                step.action == data::ScriptAction::wait)
        << step.words();
}

TEST(BoxDriver, TheInstrumentIsWhereTheHandHasIt) {
  AtTheBox at;
  at.ticks(5);
  at.mm_s = 50, at.deg_s = 120;
  at.ticks(200);
  EXPECT_EQ(at.inserted_mm(), 0) << "its tip is at the introducer now";
  at.ticks(1000);
  EXPECT_NEAR(at.inserted_mm(), 50, 1) << "less what 16 ms of smoothing are behind";
  at.mm_s = at.deg_s = 0;
  at.ticks(500);
  EXPECT_NEAR(at.inserted_mm(), at.box.station[0].advanced_mm - 10, 0.02);
  EXPECT_NEAR(at.turned_deg(), at.box.station[0].turned_deg, 0.2);
  at.mm_s = -80;
  at.ticks(400);
  at.mm_s = 0;
  at.ticks(400);
  EXPECT_NEAR(at.inserted_mm(), at.box.station[0].advanced_mm - 10, 0.02);
  EXPECT_EQ(at.run.troubles, 0u);
}

TEST(BoxDriver, SingleCountsAreNoJerks) {
  AtTheBox at;
  at.mm_s = 5;  // one count of 0.01 mm every other millisecond
  at.ticks(2500);
  double least = 1, most = 0;
  for (int i = 0; i < 200; ++i) {
    at.ticks(1);
    least = std::min(least, at.run.inputs.tools[0].feed_m_s), most = std::max(most, at.run.inputs.tools[0].feed_m_s);
  }
  EXPECT_GT(least, 4e-3);
  EXPECT_LT(most, 6e-3);
}

TEST(BoxDriver, FullTravelStopsTimeUntilTheHandIsBack) {
  AtTheBox at;
  at.mm_s = 400;
  SessionState before;
  double drew_back_mm = 0;
  long paused = 0;
  at.when_paused = [&](device::EmulatedBox& b) {
    if (paused++ == 0) before = at.run.state;
    EXPECT_EQ(hash(at.run.state), hash(before)) << "the simulation stands";
    at.mm_s = 0;
    if (drew_back_mm < 200) b.station[0].advanced_mm -= 0.5, drew_back_mm += 0.5;
  };
  while (paused == 0) at.ticks(1);
  EXPECT_GE(paused, 700) << "200 mm at half a metre a second, and 0.3 s held still";
  EXPECT_EQ(at.hand.stood(), 1);
  at.ticks(300);
  const double inserted_mm = at.inserted_mm();
  EXPECT_NEAR(inserted_mm, 295, 0.5) << "in place";
  at.mm_s = 100;
  at.ticks(500);
  at.mm_s = 0;
  at.ticks(300);
  EXPECT_NEAR(at.inserted_mm() - inserted_mm, 50, 0.1);
}

TEST(BoxDriver, ALostWireAndAPulledCableStandStill) {
  AtTheBox at;
  at.mm_s = 100;
  at.ticks(800);
  for (const bool cable : {false, true}) {
    if (cable)
      at.port.plugged = false;
    else
      at.box.station[0].quality = 3;
    at.ticks(200);
    const double stands_mm = at.inserted_mm();
    const double time_s = seconds(at.run.model, at.run.state);
    at.ticks(200);
    EXPECT_NEAR(at.inserted_mm(), stands_mm, 1e-3);
    EXPECT_NEAR(seconds(at.run.model, at.run.state) - time_s, 0.2, 1e-9) << "the patient lives on";
    EXPECT_FALSE(advice(at.hand.now()).empty());
    at.port.plugged = true, at.box.station[0].quality = 200;
    at.mm_s = 0;
    at.ticks(200);
    EXPECT_NEAR(at.inserted_mm(), stands_mm, 0.5) << "no jump";
    at.mm_s = 100;
    at.ticks(400);
    EXPECT_NEAR(at.inserted_mm() - stands_mm, 40, 3);
  }
}

TEST(BoxDriver, AnExchangeIsDrawingOutAndBringingInAnother) {
  AtTheBox at;
  at.mm_s = 100;
  at.ticks(900);
  at.mm_s = -100;
  at.ticks(900);
  at.mm_s = 0;
  at.box.station[0].tool = device::Tool::none, at.box.station[0].quality = 0;
  at.ticks(300);
  EXPECT_NEAR(at.inserted_mm(), 0, 0.1);
  at.box.station[0] = {device::Tool::wire, 200, at.box.station[0].advanced_mm + 5, 0};
  at.ticks(50);
  at.mm_s = 100;
  at.ticks(600);
  at.mm_s = 0;
  at.ticks(300);
  EXPECT_EQ(at.hand.now().tool[index_of(device::Tool::wire)].arrivals, 2u);
  EXPECT_NEAR(at.inserted_mm(), 50, 0.2) << "60 mm, of which 10 outside";
}

TEST(BoxDriver, TheNextThatArrivesIsTheNextOfItsKind) {
  const std::vector<device::Tool> held{device::Tool::guide, device::Tool::shaft, device::Tool::shaft,
                                       device::Tool::wire,  device::Tool::shaft, device::Tool::wire};
  const std::vector<ToolTurn> turns = turns_at_the_box(held);
  const std::uint32_t places[] = {0, 0, 1, 0, 2, 1}, counts[] = {1, 3, 3, 2, 3, 2};
  for (std::size_t t = 0; t < held.size(); ++t) {
    EXPECT_EQ(turns[t].place, places[t]);
    EXPECT_EQ(turns[t].count, counts[t]);
  }

  AtTheBox at(1, {}, R"({
    "schema": "ostium-script/1", "name": "two-wires", "title": "A test",
    "tools": [ { "name": "first", "instrument": "cook-j" }, { "name": "second", "instrument": "bentson" } ],
    "steps": [ { "do": "wait", "until": [{ "seconds": 1 }] } ]
  })");
  const auto inserted_mm = [&](std::size_t t) { return 1e3 * at.run.state.rods.rods[t].inserted_m; };
  for (const std::size_t t : {0u, 1u, 0u}) {
    at.ticks(5);
    at.mm_s = 100;
    at.ticks(600);
    at.mm_s = 0;
    at.ticks(300);
    EXPECT_NEAR(inserted_mm(t), 50, 0.2);
    EXPECT_NEAR(inserted_mm(1 - t), 0, 0.01) << "the other is outside";
    at.mm_s = -100;
    at.ticks(600);
    at.mm_s = 0;
    at.box.station[0].tool = device::Tool::none, at.box.station[0].quality = 0;
    at.ticks(200);
    at.box.station[0].tool = device::Tool::wire, at.box.station[0].quality = 200;
  }
}

TEST(BoxDriver, PedalsButtonsPressureAndFlow) {
  AtTheBox at;
  at.box.pedals = 1, at.box.pressure_atm = -0.8, at.box.flow_mL_s = 3;
  at.ticks(5);
  EXPECT_EQ(at.run.inputs.c_arm.fluoroscopy, 1);
  EXPECT_EQ(at.run.inputs.c_arm.cine, 0);
  EXPECT_NEAR(at.hand.pressure_Pa(), -0.8 * 101'325, 60);
  EXPECT_NEAR(at.hand.flow_m3_s(), 3e-6, 1e-8);
  at.box.pedals = 2 | 8;
  at.ticks(5);
  EXPECT_EQ(at.run.inputs.c_arm.cine, 1);
  EXPECT_DOUBLE_EQ(at.run.inputs.c_arm.lao_rad, -0.5);
  at.box.pedals = 4;
  at.ticks(5);
  EXPECT_DOUBLE_EQ(at.run.inputs.c_arm.lao_rad, 0.7) << "and it stays when the button is let go";
  at.box.pedals = 0;
  at.ticks(5);
  EXPECT_DOUBLE_EQ(at.run.inputs.c_arm.lao_rad, 0.7);
}

/// In a patient, the box's indeflator and syringe set the delivery inputs.
TEST(BoxDriver, PressureInflatesAndFlowInjectsOrDrawsBack) {
  RunSetup setup;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, setup);
  set_script(data::find_script("iliac-wire"), setup);
  setup.script = free_hands(setup.script);
  std::string warnings;
  device::EmulatedBox box{{}};
  device::EmulatedPort port{box, {}};
  device::TrackingBox host{port, {}};
  BoxDriver hand{{}, [&](const device::BoxRequest& request) -> const device::BoxSnapshot& {
                   host.poll(0, request);
                   return host.now();
                 }};
  ScriptedRun run(setup, make_vessel(setup, warnings), &hand);
  const auto ticks = [&](double atm, double mL_s) {
    box.pressure_atm = atm, box.flow_mL_s = mL_s;
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(run.tick());
  };
  ticks(-0.8, 3);
  EXPECT_NEAR(run.inputs.delivery.gauge_Pa, -0.8 * 101'325, 60);
  EXPECT_NEAR(run.inputs.delivery.injection_m3_s, 3e-6, 1e-8);
  ticks(12, -2);
  EXPECT_NEAR(run.inputs.delivery.gauge_Pa, 12 * 101'325, 60);
  EXPECT_EQ(run.inputs.delivery.injection_m3_s, 0);
  EXPECT_NEAR(run.inputs.delivery.aspiration_m3_s, 2e-6, 1e-8);
  ticks(0.03, 0.03);
  EXPECT_EQ(run.inputs.delivery.gauge_Pa, 0) << "an offset is no hand";
  EXPECT_EQ(run.inputs.delivery.injection_m3_s, 0);
  EXPECT_EQ(run.inputs.delivery.aspiration_m3_s, 0);
}

TEST(BoxDriver, DoesNotAllocate) {
  AtTheBox at;
  at.mm_s = 60, at.deg_s = 90;
  at.ticks(1500);
  const long before = allocations();
  at.ticks(500);
  EXPECT_EQ(allocations(), before);
}

TEST(BoxDriver, TheClampHoldsWhatTheWirePushes) {
  AtTheBox at;
  at.mm_s = 100;
  at.ticks(2500);
  at.mm_s = 30;
  double most_push_N = 0;
  for (int i = 0; i < 1000; ++i) {
    at.ticks(1);
    most_push_N = std::max(most_push_N, at.run.report.tools[0].push_N);
  }
  const double level_N = at.box.clamp()[0] / 65535.0 * 10;
  EXPECT_GT(most_push_N, 0.03) << "its bend, and friction in it";
  EXPECT_NEAR(level_N, at.run.report.tools[0].push_N, 0.15 * most_push_N + 0.03);
}

/// The closed loop including rods and walls: an arm of 0.1 kg, 300 N/m and 4 N s/m pushes and turns the wire to the
/// tube's closed end and holds still; sensor noise is 0.02 mm, and clamp commands arrive 20 ms late. With higher wall
/// friction the clamp holds more, and is quiet.
TEST(BoxDriver, TheClampIsQuietHoweverHighTheWallsFriction) {
  double before_N = 0;
  for (const double friction : {0.05, 0.3, 0.9}) {
    AtTheBox at(20, friction);
    std::mt19937 generator(7);
    double hand_mm = 0, hand_mm_s = 0, wanted_mm = 0;
    at.moves = [&](device::EmulatedBox& b) {
      const double mass = 0.1, dt = 1e-4, brake_N = b.clamp()[0] / 65535.0 * 10;
      for (int i = 0; i < 10; ++i) {
        const double pull_N = 0.3 * (wanted_mm - hand_mm) - 4e-3 * hand_mm_s;
        const double free_mm_s = hand_mm_s + 1e3 * pull_N / mass * dt;
        hand_mm_s = std::copysign(std::max(0.0, std::abs(free_mm_s) - 1e3 * brake_N / mass * dt), free_mm_s);
        hand_mm += hand_mm_s * dt;
      }
      b.station[0].advanced_mm = hand_mm + std::uniform_real_distribution<double>(-0.02, 0.02)(generator);
      b.station[0].turned_deg = 0.5 * wanted_mm;
    };
    at.ticks(5);
    for (int i = 0; i < 2940; ++i) wanted_mm = 0.1 * i, at.ticks(1);
    const double level_N = at.box.clamp()[0] / 65535.0 * 10;
    at.ticks(700);
    double path_N = 0;
    for (int i = 0; i < 1000; ++i) {
      const std::uint16_t before = at.box.clamp()[0];
      at.ticks(1);
      path_N += std::abs(at.box.clamp()[0] - before) / 65535.0 * 10;
    }
    EXPECT_LT(path_N, 0.1) << "friction " << friction;
    EXPECT_GT(level_N, before_N) << "friction " << friction;
    before_N = level_N;
    std::printf("friction %.2f: pushed against %.2f N, held: %.3f N/s\n", friction, level_N, path_N);
  }
  EXPECT_GT(before_N, 0.08) << "twice what it is almost without friction";
}

TEST(BoxRun, AtTheEmulatorRecordsAndReplays) {
  RunSetup setup = tube_setup();
  const auto device = run_at_emulator({}, nullptr);
  ScriptedRun run(setup, tube_vessel(), &device->driver());
  PlayOptions options;
  options.recorder.file = testing::TempDir() + "device_run.h5";
  const PlayReport report = play(run, setup, options);
  EXPECT_EQ(report.outcome, "success") << report.reason;
  Replay replay(options.recorder.file, tube_vessel());
  const VerifyReport verified = verify(replay);
  EXPECT_GT(verified.steps, 1000u);
  EXPECT_FALSE(verified.first_step);
  EXPECT_EQ(hash(replay.state), report.hash);
  std::filesystem::remove(options.recorder.file);
}

TEST(BoxRun, EndsWhenItIsStoppedWhileItStands) {
  AtTheBox at;
  at.mm_s = 400;
  at.when_paused = [&](device::EmulatedBox&) { at.stop = true; };
  while (at.run.tick()) {
  }
  EXPECT_EQ(at.run.outcome, Outcome::ended) << "by the one at the box";
}

}  // namespace
}  // namespace ostium::app
