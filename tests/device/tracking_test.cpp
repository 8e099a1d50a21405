#include "device/host/tracking.h"

#include <gtest/gtest.h>

#include <random>

#include "device/emulator/emulated_box.h"

namespace ostium::device {
namespace {

/// A box with a wire under its first station, and the host's tracking.
struct TrackedWire {
  Calibration calibration;
  EmulatedBox box{calibration};
  TrackingState state;
  double advanced_mm = 0, turned_deg = 0;

  TrackedWire() { box.station[0] = {Tool::wire, 200, 0, 0}; }
  Movements read() { return movements(calibration, parse_in_report(box.sample()).value(), state); }
  Movements follow() {
    const Movements m = read();
    const ToolMovement& wire = m.tool[index_of(Tool::wire)];
    advanced_mm += wire.advance_mm, turned_deg += wire.turn_deg;
    return m;
  }
};

TEST(Tracking, FollowsAHandWithinACount) {
  TrackedWire rig;
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> hand(-0.5, 0.6);
  rig.follow();
  for (int i = 0; i < 20'000; ++i) {
    auto& wire = rig.box.station[0];
    wire.advanced_mm += hand(generator), wire.turned_deg += 10 * hand(generator);
    rig.follow();
    ASSERT_NEAR(rig.advanced_mm, wire.advanced_mm, 0.01);
    ASSERT_NEAR(rig.turned_deg, wire.turned_deg, 0.1);
  }
  EXPECT_GT(rig.advanced_mm, 500);
}

/// Across the largest and the smallest count, in both directions.
TEST(Tracking, CountsWrapAround) {
  for (const double way : {1.0, -1.0}) {
    TrackedWire rig;
    auto& wire = rig.box.station[0];
    const double edge_mm = way * 2147483640.0 * rig.calibration.track[0].mm_per_count;
    wire.advanced_mm = edge_mm;
    rig.follow();
    for (int i = 0; i < 10; ++i) {
      wire.advanced_mm += way * 0.5;
      EXPECT_NEAR(rig.follow().tool[1].advance_mm, way * 0.5, 0.011);
    }
    EXPECT_NEAR(rig.advanced_mm, way * 5, 0.011);
  }
}

TEST(Tracking, LostReportsLoseNoMovement) {
  TrackedWire rig;
  rig.follow();
  for (int i = 0; i < 7; ++i) rig.box.sample();
  rig.box.station[0].advanced_mm = 3;
  const Movements m = rig.follow();
  EXPECT_EQ(m.lost_reports, 7u);
  EXPECT_NEAR(m.elapsed_s, 0.008, 1e-9);
  EXPECT_NEAR(rig.advanced_mm, 3, 0.011);
}

TEST(Tracking, ARepeatedReportMovesNothing) {
  TrackedWire rig;
  rig.follow();
  rig.box.station[0].advanced_mm = 2;
  const InReport report = parse_in_report(rig.box.sample()).value();
  movements(rig.calibration, report, rig.state);
  const Movements again = movements(rig.calibration, report, rig.state);
  EXPECT_TRUE(again.repeated);
  EXPECT_EQ(again.tool[1].advance_mm, 0);
  EXPECT_TRUE(again.tool[1].seen);
}

/// The clock wraps after 71.6 min, the sequence after 50 days.
TEST(Tracking, ClockAndSequenceWrapAround) {
  TrackedWire rig;
  InReport r = parse_in_report(rig.box.sample()).value();
  r.sequence = 0xffffffff, r.time_us = 0xffffff00;
  movements(rig.calibration, r, rig.state);
  r.sequence = 0, r.time_us = 744;
  const Movements m = movements(rig.calibration, r, rig.state);
  EXPECT_FALSE(m.restarted || m.repeated);
  EXPECT_NEAR(m.elapsed_s, 1e-3, 1e-9);
}

/// Movement while a tool is not seen is unknown, so none is reported.
TEST(Tracking, QualityLosesAndFindsWithHysteresis) {
  TrackedWire rig;
  rig.follow();
  auto& wire = rig.box.station[0];
  const auto seen_at = [&](int quality) {
    wire.quality = static_cast<std::uint8_t>(quality);
    wire.advanced_mm += 1;
    return rig.follow().tool[1].seen;
  };
  EXPECT_TRUE(seen_at(lost_below_quality));
  EXPECT_NEAR(rig.advanced_mm, 1, 0.011);
  EXPECT_FALSE(seen_at(lost_below_quality - 1));
  EXPECT_FALSE(seen_at(found_from_quality - 1));
  EXPECT_TRUE(seen_at(found_from_quality));
  EXPECT_NEAR(rig.advanced_mm, 1, 0.011);
  EXPECT_TRUE(seen_at(found_from_quality));
  EXPECT_NEAR(rig.advanced_mm, 2, 0.011);
}

TEST(Tracking, ARestartedBoxDoesNotJump) {
  TrackedWire rig;
  rig.follow();
  for (int i = 0; i < 100; ++i) rig.follow();
  rig.box = EmulatedBox(rig.calibration);
  rig.box.station[0] = {Tool::wire, 200, 500, 0};
  EXPECT_TRUE(rig.follow().restarted);
  EXPECT_EQ(rig.advanced_mm, 0);
}

/// Two stations see one wire: it moves once, and switching stations causes no jump.
TEST(Tracking, StationsHandAToolOver) {
  TrackedWire rig;
  auto& a = rig.box.station[0];
  auto& b = rig.box.station[1];
  b = {Tool::wire, 100, 77, 0};
  rig.follow();
  for (int i = 0; i < 100; ++i) {
    a.advanced_mm += 0.1, b.advanced_mm += 0.1;
    if (i == 50) a.quality = 60;
    rig.follow();
  }
  EXPECT_NEAR(rig.advanced_mm, 10, 0.03);
}

}  // namespace
}  // namespace ostium::device
