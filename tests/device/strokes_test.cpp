#include "device/host/strokes.h"

#include <gtest/gtest.h>

#include "device/emulator/emulated_box.h"

namespace ostium::device {
namespace {

constexpr std::size_t wire = index_of(Tool::wire), shaft = index_of(Tool::shaft);

/// Moves tools of an emulated box; connected only through its bytes.
struct Rig {
  Calibration calibration;
  EmulatedBox box;
  TrackingState tracking;
  StrokeSettings settings;
  StrokeState hands;
  double advanced_mm = 0, turned_deg = 0;  // of the wire's instrument

  Rig() : calibration(stations_outside()), box(calibration) {}
  static Calibration stations_outside() {
    Calibration c;
    for (auto& t : c.track) t.before_introducer_mm = 20;
    return c;
  }
  void tick() {
    const auto report = parse_in_report(box.sample()).value();
    const auto moved = follow(settings, movements(calibration, report, tracking), hands);
    advanced_mm += moved[wire].advance_mm, turned_deg += moved[wire].turn_deg;
  }
  void show(std::size_t k, Tool tool) { box.station[k].tool = tool, box.station[k].quality = 200, tick(); }
  /// At 0.2 m/s.
  void push(std::size_t k, double mm) {
    const int ticks = static_cast<int>(std::abs(mm) / 0.2 + 0.5);
    for (int i = 0; i < ticks; ++i) box.station[k].advanced_mm += mm / ticks, tick();
  }
  void wait(int ms) {
    for (int i = 0; i < ms; ++i) tick();
  }
};

TEST(Strokes, AToolAppearsAtItsStation) {
  Rig rig;
  EXPECT_EQ(rig.hands.tool[wire].sight, ToolPresence::absent);
  rig.show(0, Tool::wire);
  EXPECT_EQ(rig.hands.tool[wire].sight, ToolPresence::seen);
  EXPECT_EQ(rig.hands.tool[wire].inserted_mm, -20);
  rig.push(0, 50);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, 30, 0.011);
  zero(rig.hands, Tool::wire);
  rig.push(0, 10);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, 10, 0.022);
}

/// A balloon is exchanged for a stent over a stationary wire, which is not affected.
TEST(Strokes, ExchangeOverTheWire) {
  Rig rig;
  rig.show(0, Tool::wire);
  rig.push(0, 200);
  rig.show(1, Tool::shaft);
  EXPECT_EQ(rig.hands.tool[shaft].arrivals, 1u);
  rig.push(1, 150);
  rig.push(1, -150);
  rig.show(1, Tool::none);
  EXPECT_EQ(rig.hands.tool[shaft].sight, ToolPresence::absent);
  rig.push(1, 37);  // the next one approaches: not seen yet
  rig.show(1, Tool::shaft);
  EXPECT_EQ(rig.hands.tool[shaft].arrivals, 2u);
  EXPECT_EQ(rig.hands.tool[shaft].inserted_mm, -20);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, 180, 0.011);
  EXPECT_EQ(rig.hands.tool[wire].arrivals, 1u);
}

/// A wire inside the patient cannot have been removed: it is lost, and found again where it was.
TEST(Strokes, ALostWireIsSaidToBeLost) {
  Rig rig;
  rig.show(0, Tool::wire);
  rig.push(0, 100);
  rig.box.station[0].quality = 0;
  rig.push(0, 30);
  EXPECT_EQ(rig.hands.tool[wire].sight, ToolPresence::lost);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, 80, 0.011);
  rig.box.station[0].quality = 200;
  rig.tick();
  rig.push(0, 10);
  EXPECT_EQ(rig.hands.tool[wire].sight, ToolPresence::seen);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, 90, 0.022);
  EXPECT_EQ(rig.hands.tool[wire].arrivals, 1u);
}

TEST(Strokes, FullTravelPausesAndResumesInPlace) {
  Rig rig;
  rig.show(0, Tool::wire);
  rig.push(0, 315);
  EXPECT_EQ(rig.hands.pause, Pause::none);
  rig.push(0, 10);
  ASSERT_EQ(rig.hands.pause, Pause::travel_full);
  EXPECT_EQ(rig.hands.paused_by, Tool::wire);
  const double there_mm = rig.hands.tool[wire].inserted_mm;
  EXPECT_NEAR(there_mm, 295, 0.21);
  rig.wait(300);
  EXPECT_EQ(rig.hands.picture, 0);
  EXPECT_EQ(rig.hands.pause, Pause::travel_full);  // held still, but not drawn back
  rig.box.station[0].turned_deg += 90;
  rig.push(0, -200);
  EXPECT_EQ(rig.hands.pause, Pause::travel_full);  // drawn back, but not held still
  EXPECT_EQ(rig.hands.tool[wire].inserted_mm, there_mm);
  rig.wait(320);
  EXPECT_EQ(rig.hands.pause, Pause::none);
  EXPECT_EQ(rig.hands.tool[wire].inserted_mm, there_mm);
  EXPECT_EQ(rig.turned_deg, 0);
  rig.wait(300);
  EXPECT_EQ(rig.hands.picture, 1);
  rig.push(0, 50);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, there_mm + 50, 0.022);
}

/// 1.1 m, as from the groin to the aortic root, and out again, 30 cm at a time.
TEST(Strokes, ManyStrokesReachTheRootAndComeBack) {
  Rig rig;
  rig.show(0, Tool::wire);
  int strokes = 0;
  while (rig.hands.tool[wire].inserted_mm < 1100 && ++strokes < 20) {
    while (rig.hands.pause == Pause::none && rig.hands.tool[wire].inserted_mm < 1100) rig.push(0, 1);
    if (rig.hands.pause == Pause::none) break;
    rig.push(0, -270);
    rig.wait(350);
  }
  EXPECT_EQ(strokes, 4);  // to 295, then 270 each: 1105
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, 1100, 1.1);
  EXPECT_NEAR(rig.hands.tool[wire].inserted_mm, rig.advanced_mm - 20, 1e-6);
  for (strokes = 0; rig.hands.tool[wire].inserted_mm > -20 && ++strokes < 20;) {
    while (rig.hands.pause == Pause::none && rig.hands.tool[wire].inserted_mm > -20) rig.push(0, -1);
    if (rig.hands.pause == Pause::none) break;
    ASSERT_EQ(rig.hands.pause, Pause::travel_empty);
    rig.push(0, 280);
    rig.wait(350);
  }
  rig.show(0, Tool::none);
  EXPECT_EQ(rig.hands.tool[wire].sight, ToolPresence::absent);
  EXPECT_NEAR(rig.advanced_mm, 0, 1.1);
}

/// While the wire is drawn back, the shaft moves along: neither instrument moves.
TEST(Strokes, APauseHoldsAllInstruments) {
  Rig rig;
  rig.show(0, Tool::wire), rig.show(1, Tool::shaft);
  rig.push(1, 100);
  rig.push(0, 330);
  ASSERT_EQ(rig.hands.pause, Pause::travel_full);
  rig.push(1, -40);
  EXPECT_NEAR(rig.hands.tool[shaft].inserted_mm, 80, 0.011);
  EXPECT_NEAR(rig.hands.tool[shaft].in_box_mm, 40, 0.022);
}

}  // namespace
}  // namespace ostium::device
