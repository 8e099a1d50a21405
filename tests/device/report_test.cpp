#include "device/protocol/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

namespace ostium::device {
namespace {

using ReportBytes = std::vector<std::uint8_t>;

/// A report written by hand, byte by byte, from the protocol's table.
ReportBytes by_hand() {
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
  EXPECT_EQ(ReportBytes(again.begin(), again.end()), by_hand());
}

TEST(Report, WhatBreaksARuleIsIgnoredWhole) {
  const auto refused = [](std::size_t at, std::uint8_t value) {
    ReportBytes bytes = by_hand();
    bytes[at] = value;
    return !parse_in_report(bytes);
  };
  EXPECT_TRUE(refused(0, 2));
  EXPECT_TRUE(refused(1, 2));
  EXPECT_TRUE(refused(2, 0x20));
  EXPECT_TRUE(refused(3, 0x01));
  EXPECT_TRUE(refused(55, 5));
  EXPECT_FALSE(refused(60, 0xff));
  ReportBytes shorter = by_hand(), longer = by_hand();
  shorter.pop_back(), longer.push_back(0);
  EXPECT_FALSE(parse_in_report(shorter));
  EXPECT_FALSE(parse_in_report(longer));
  EXPECT_FALSE(parse_in_report({}));
}

TEST(Report, BrakesForPushingAndTurningGoThereAndBack) {
  OutReport asked{0xabcd, {0, 1, 0x1234, 0xffff}, false, true, {}};
  asked.rotary = {9, 8, 7, 0x0506};
  auto bytes = brake_bytes_of(asked);
  const ReportBytes expected = {0x82, 1, 0xcd, 0xab, 0, 0, 1, 0, 0x34, 0x12, 0xff, 0xff,
                                9,    0, 8,    0,    7, 0, 6, 5, 2,    0,    0,    0};
  EXPECT_EQ(ReportBytes(bytes.begin(), bytes.end()), expected);
  const auto read = parse_out_report(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->clamp, asked.clamp);
  EXPECT_EQ(read->rotary, asked.rotary);
  EXPECT_TRUE(!read->arm && read->identify);
  EXPECT_EQ(flaw_of_out_report(std::span(bytes).first(16)), Flaw::length);
  bytes[22] = 1;
  EXPECT_EQ(flaw_of_out_report(bytes), Flaw::reserved_bits);
  asked.rotary.reset();
  EXPECT_EQ(parse_out_report(brake_bytes_of(asked))->rotary, asked.clamp) << "one level for both";
}

TEST(Report, OutReportsGoThereAndBack) {
  const OutReport asked{0xabcd, {0, 1, 0x1234, 0xffff}, true, false};
  auto bytes = bytes_of(asked);
  const ReportBytes expected = {0x81, 1, 0xcd, 0xab, 0, 0, 1, 0, 0x34, 0x12, 0xff, 0xff, 1, 0, 0, 0};
  EXPECT_EQ(ReportBytes(bytes.begin(), bytes.end()), expected);
  const auto read = parse_out_report(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->clamp, asked.clamp);
  EXPECT_FALSE(read->rotary);
  EXPECT_TRUE(read->arm && !read->identify);
  bytes[12] = 4;
  EXPECT_FALSE(parse_out_report(bytes));
  bytes[12] = 1, bytes[15] = 1;
  EXPECT_FALSE(parse_out_report(bytes));
}

TEST(Report, SaysWhichRuleIsBroken) {
  const auto flaw = [](std::size_t at, std::uint8_t value) {
    ReportBytes bytes = by_hand();
    bytes[at] = value;
    return flaw_of_in_report(bytes);
  };
  EXPECT_EQ(flaw(0, 0x02), Flaw::type);
  EXPECT_EQ(flaw(1, 2), Flaw::version);
  EXPECT_EQ(flaw(2, 0x20), Flaw::reserved_bits);
  EXPECT_EQ(flaw(53, 5), Flaw::tool);
  const ReportBytes whole = by_hand();
  EXPECT_EQ(flaw_of_in_report(std::span(whole).first(63)), Flaw::length);
  EXPECT_EQ(flaw_of_in_report({}), Flaw::length);
  EXPECT_EQ(flaw_of_out_report(by_hand()), Flaw::type);
}

/// A second, independent implementation of the rules, from the protocol's table.
bool keeps_rules_in(const ReportBytes& b) {
  return b.size() == 64 && b[0] == 1 && b[1] == 1 && b[2] < 32 && b[3] == 0 && b[52] < 5 && b[53] < 5 && b[54] < 5 &&
         b[55] < 5;
}
bool keeps_rules_out(const ReportBytes& b) {
  return b.size() == 16 && b[0] == 0x81 && b[1] == 1 && b[12] < 4 && b[13] == 0 && b[14] == 0 && b[15] == 0;
}

/// Reports of any length, mostly nearly valid. Exactly those that keep the rules are accepted, and they are written
/// back identically. OSTIUM_FUZZ_REPORTS=10000000 for the long run.
TEST(Report, RandomBytesKeepTheRules) {
  const char* wanted = std::getenv("OSTIUM_FUZZ_REPORTS");
  const long reports = wanted ? std::atol(wanted) : 1'000'000;
  std::mt19937_64 generator(1);
  const ReportBytes in = by_hand();
  const auto out = bytes_of(OutReport{7, {1, 2, 3, 4}, true, true});
  long taken[2] = {}, refused = 0;
  ReportBytes bytes;
  for (long i = 0; i < reports; ++i) {
    const auto dice = generator();
    if (dice & 1)
      bytes = in;
    else
      bytes.assign(out.begin(), out.end());
    if ((dice >> 1 & 15) == 0) bytes.resize(dice >> 8 & 127, 0);
    const bool wild = (dice >> 5 & 7) == 0;
    for (std::size_t k = 0; k < (wild ? bytes.size() : bytes.empty() ? 0 : 3); ++k)
      bytes[wild ? k : generator() % bytes.size()] = static_cast<std::uint8_t>(generator());
    const auto in_read = parse_in_report(bytes);
    const auto out_read = parse_out_report(bytes);
    ASSERT_EQ(in_read.has_value(), keeps_rules_in(bytes));
    ASSERT_EQ(out_read.has_value(), keeps_rules_out(bytes));
    ASSERT_EQ(in_read.has_value(), flaw_of_in_report(bytes) == Flaw::none);
    ASSERT_TRUE(!in_read || std::ranges::equal(bytes_of(*in_read), bytes));
    ASSERT_TRUE(!out_read || std::ranges::equal(bytes_of(*out_read), bytes));
    taken[0] += in_read.has_value(), taken[1] += out_read.has_value(), refused += !in_read && !out_read;
  }
  EXPECT_GT(taken[0], reports / 5);
  EXPECT_GT(taken[1], reports / 20);
  EXPECT_GT(refused, reports / 5);
}

}  // namespace
}  // namespace ostium::device
