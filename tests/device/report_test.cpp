#include "device/report.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ostium {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A report written out by hand, byte by byte, from the protocol's table.
Bytes by_hand() {
  return {0x01, 0x01, 0x11, 0x00,                           // type, version, status: armed, calibrated
          0x78, 0x56, 0x34, 0x12, 0x40, 0x42, 0x0f, 0x00,   // sequence 0x12345678, 1 s
          0x02, 0x00, 0x34, 0x12,                           // overruns 2, last OUT 0x1234
          0xff, 0xff, 0xff, 0xff, 0x00, 0x00, 0x00, 0x80,   // insertion -1, -2^31
          0x64, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,   // 100, 0
          0x01, 0x00, 0x00, 0x00, 0xfe, 0xff, 0xff, 0xff,   // roll 1, -2
          0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00,   // 0, 256
          0xff, 0x80, 0x01, 0x00, 0x01, 0x02, 0x03, 0x00,   // quality; guide, wire, shaft, none
          0x00, 0x80, 0x0a, 0x00, 0x03, 0x00, 0x07, 0x00};  // pressure -32768, flow 10, both pedals, 7 ms
}

TEST(Report, ReadsWhatWasWrittenByHand) {
  const auto r = parse_in_report(by_hand());
  ASSERT_TRUE(r);
  EXPECT_TRUE(r->armed && r->calibrated && !r->watchdog && !r->emergency_stop && !r->over_temperature);
  EXPECT_EQ(r->sequence, 0x12345678u);
  EXPECT_EQ(r->time_us, 1'000'000u);
  EXPECT_EQ(r->last_out_sequence, 0x1234);
  EXPECT_EQ(r->insertion, (std::array<std::int32_t, 4>{-1, INT32_MIN, 100, 0}));
  EXPECT_EQ(r->roll, (std::array<std::int32_t, 4>{1, -2, 0, 256}));
  EXPECT_EQ(r->tool, (std::array<Tool, 4>{Tool::guide, Tool::wire, Tool::shaft, Tool::none}));
  EXPECT_EQ(r->pressure, -32768);
  EXPECT_EQ(r->flow, 10);
  EXPECT_EQ(r->pedals, 3);
  EXPECT_EQ(r->age_of_last_out_ms, 7);
  const auto again = bytes_of(*r);
  EXPECT_EQ(Bytes(again.begin(), again.end()), by_hand());
}

TEST(Report, WhatBreaksARuleIsIgnoredWhole) {
  const auto refused = [](std::size_t at, std::uint8_t value) {
    Bytes bytes = by_hand();
    bytes[at] = value;
    return !parse_in_report(bytes);
  };
  EXPECT_TRUE(refused(0, 2));
  EXPECT_TRUE(refused(1, 2));
  EXPECT_TRUE(refused(2, 0x20));
  EXPECT_TRUE(refused(3, 0x01));
  EXPECT_TRUE(refused(55, 5));
  EXPECT_FALSE(refused(60, 0xff));
  Bytes shorter = by_hand(), longer = by_hand();
  shorter.pop_back(), longer.push_back(0);
  EXPECT_FALSE(parse_in_report(shorter));
  EXPECT_FALSE(parse_in_report(longer));
  EXPECT_FALSE(parse_in_report({}));
}

TEST(Report, OutReportsGoThereAndBack) {
  const OutReport asked{0xabcd, {0, 1, 0x1234, 0xffff}, true, false};
  auto bytes = bytes_of(asked);
  const Bytes expected = {0x81, 1, 0xcd, 0xab, 0, 0, 1, 0, 0x34, 0x12, 0xff, 0xff, 1, 0, 0, 0};
  EXPECT_EQ(Bytes(bytes.begin(), bytes.end()), expected);
  const auto read = parse_out_report(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->clamp, asked.clamp);
  EXPECT_TRUE(read->arm && !read->identify);
  bytes[12] = 4;
  EXPECT_FALSE(parse_out_report(bytes));
  bytes[12] = 1, bytes[15] = 1;
  EXPECT_FALSE(parse_out_report(bytes));
}

/// Any bytes: no crash, and what is taken keeps every rule, for it writes itself back to the same bytes.
TEST(Report, RandomBytesKeepTheRules) {
  std::mt19937 generator(1);
  int taken = 0;
  for (int i = 0; i < 200'000; ++i) {
    Bytes bytes = by_hand();
    for (int k = 0; k < 3; ++k) bytes[generator() % bytes.size()] = static_cast<std::uint8_t>(generator());
    if (const auto r = parse_in_report(bytes)) {
      const auto again = bytes_of(*r);
      ASSERT_EQ(Bytes(again.begin(), again.end()), bytes);
      ++taken;
    }
  }
  EXPECT_GT(taken, 100'000);
}

}  // namespace
}  // namespace ostium
