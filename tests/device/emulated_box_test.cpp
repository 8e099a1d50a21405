#include "device/emulator/emulated_box.h"

#include <gtest/gtest.h>

#include <random>

#include "device/protocol/bytes.h"

namespace ostium::device {
namespace {

const std::array<std::uint16_t, 4> levels{100, 200, 300, 400};

void send(EmulatedBox& box, bool arm) { box.take(bytes_of(OutReport{1, levels, arm, false})); }
InReport read(EmulatedBox& box) { return parse_in_report(box.sample()).value(); }
EmulatedBox armed_box() {
  EmulatedBox box{Calibration{}};
  send(box, false), send(box, true);
  return box;
}

TEST(EmulatedBox, IsOpenUntilArmGoesUp) {
  EmulatedBox box{Calibration{}};
  send(box, true);
  EXPECT_EQ(box.clamp()[0], 0);
  send(box, false), send(box, true);
  EXPECT_EQ(box.clamp(), levels);
  EXPECT_TRUE(read(box).armed);
}

TEST(EmulatedBox, HasBrakesForPushingAndTurningOrOneForBoth) {
  OutReport report{1, levels, false, false, {}};
  report.rotary = {5, 6, 7, 8};
  for (const bool separate : {false, true}) {
    EmulatedBox box{Calibration{}};
    box.separate_brakes = separate;
    EXPECT_EQ(parse_info(*box.control(1, 0))->separate_brakes, separate);
    for (const bool arm : {false, true}) report.arm = arm, box.take(brake_bytes_of(report));
    EXPECT_EQ(box.clamp()[2], separate ? levels[2] : 0) << "a box without them knows no such reports";
    EXPECT_EQ(box.rotary()[2], separate ? 7 : 0);
    send(box, false), send(box, true);
    EXPECT_EQ(box.clamp(), levels) << "it takes those for one clamp, too";
    EXPECT_EQ(box.rotary(), levels);
    box.release();
    EXPECT_EQ(box.clamp()[0] + box.rotary()[0], 0);
  }
  EXPECT_FALSE(parse_info(std::vector<std::uint8_t>{1, 4, 1, 0, 0, 0, 0, 0})->separate_brakes) << "of a first box";
  EXPECT_FALSE(parse_info(std::vector<std::uint8_t>(7, 1)));
}

TEST(EmulatedBox, WatchdogOpensWithinItsTimeAndStaysOpen) {
  EmulatedBox box = armed_box();
  int ms = 0;
  while (box.clamp()[0] != 0 && ms < 1000) box.sample(), ++ms;
  EXPECT_EQ(ms, 50);  // the protocol's default; the requirement is 60
  EXPECT_TRUE(read(box).watchdog);
  send(box, true);
  EXPECT_EQ(box.clamp()[0], 0);
  send(box, false), send(box, true);
  EXPECT_EQ(box.clamp(), levels);
  EXPECT_FALSE(read(box).watchdog);
  EXPECT_EQ(get<std::uint32_t>(*box.control(8, 0), 12), 1u);
}

/// Reports that break a rule do not keep the clamps closed.
TEST(EmulatedBox, DamagedReportsDoNotFeedTheWatchdog) {
  EmulatedBox box = armed_box();
  auto bad = bytes_of(OutReport{2, levels, true, false});
  bad[14] = 1;
  for (int ms = 0; ms < 50; ++ms) box.take(bad), box.sample();
  EXPECT_EQ(box.clamp()[0], 0);
  EXPECT_EQ(get<std::uint32_t>(*box.control(8, 0), 8), 50u);
}

TEST(EmulatedBox, StopsAndReleasesNeedANewArm) {
  for (int why = 0; why < 3; ++why) {
    EmulatedBox box = armed_box();
    box.emergency_stop = why == 0, box.over_temperature = why == 1;
    if (why == 2) box.release();
    const InReport r = read(box);
    EXPECT_TRUE(!r.armed && r.emergency_stop == (why == 0) && r.over_temperature == (why == 1));
    send(box, false);
    if (why < 2) send(box, true);
    EXPECT_EQ(box.clamp()[0], 0);
    box.emergency_stop = box.over_temperature = false;
    send(box, false), send(box, true);
    EXPECT_EQ(box.clamp(), levels);
  }
}

TEST(EmulatedBox, ControlRequestsHoldTheirLimits) {
  EmulatedBox box{Calibration{}};
  for (const int unknown : {0, 9, 255}) EXPECT_FALSE(box.control(static_cast<std::uint8_t>(unknown), 0));
  EXPECT_FALSE(box.control(6, 9));
  EXPECT_FALSE(box.control(6, 501));
  EXPECT_TRUE(box.control(6, 10));
  EXPECT_FALSE(box.control(7, 300));
  EXPECT_TRUE(box.control(7, 125));
  box.sample();
  EXPECT_DOUBLE_EQ(box.time_s(), 0.008);
  const auto info = *box.control(1, 0);
  EXPECT_EQ(get<std::uint16_t>(info, 4), 125);
  EXPECT_EQ(get<std::uint16_t>(info, 6), 10);
}

TEST(EmulatedBox, CalibrationIsWrittenWholeWithTheKeyAndDisarmed) {
  EmulatedBox box{Calibration{}};
  Calibration c;
  c.serial = "NEW";
  c.track[1].mm_per_count = 0.05f;
  auto record = bytes_of(c);
  EXPECT_FALSE(box.control(4, calibration_key));
  EXPECT_FALSE(box.control(3, 0, record));
  EXPECT_TRUE(box.control(3, calibration_key, record));
  EXPECT_FALSE(box.control(4, 0));
  EXPECT_EQ(box.calibration().serial, "");
  EXPECT_TRUE(box.control(4, calibration_key));
  EXPECT_EQ(bytes_of(parse_calibration(*box.control(2, 0))), record);
  record[40] ^= 1;
  EXPECT_TRUE(box.control(3, calibration_key, record));
  EXPECT_FALSE(box.control(4, calibration_key));
  EXPECT_EQ(box.calibration().serial, "NEW");
  send(box, false), send(box, true);
  EXPECT_FALSE(box.control(3, calibration_key, record));
}

/// 10,000 damaged reports on the wire: the clamps never close, and every report is counted once.
TEST(EmulatedBox, FuzzedOutReportsNeverCloseAClamp) {
  EmulatedBox box{Calibration{}};
  send(box, false);
  std::mt19937 generator(5);
  for (int i = 0; i < 10'000; ++i) {
    auto bytes = bytes_of(OutReport{1, levels, true, false});
    const std::array<std::size_t, 5> guarded{0, 1, 13, 14, 15};
    bytes[guarded[generator() % 5]] ^= static_cast<std::uint8_t>(1 + generator() % 255);
    box.take(bytes);
    ASSERT_EQ(box.clamp()[0], 0);
    box.sample();
  }
  EXPECT_EQ(get<std::uint32_t>(*box.control(8, 0), 8), 10'000u);
}

}  // namespace
}  // namespace ostium::device
