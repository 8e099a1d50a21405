#include "device/protocol/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "device/protocol/bytes.h"

namespace ostium::device {
namespace {

Calibration example() {
  Calibration c;
  c.serial = "LAB-0001";
  c.date = 20260131;
  for (std::size_t k = 0; k < 4; ++k) {
    const float f = static_cast<float>(k + 1);
    c.track[k] = {0.0125f * f, -0.25f * f, 0.001f * f, 100 * f};
    c.clamp_full_scale_N[k] = 5 * f;
  }
  c.atm_per_count = 0.002f, c.pressure_offset_atm = -0.1f;
  c.mL_s_per_count = 0.02f, c.flow_offset_mL_s = 0.5f;
  return c;
}

/// The CRC-32 of IEEE 802.3, bit by bit, from its definition.
std::uint32_t crc_by_definition(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const auto byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

template <class Bytes>
void seal(Bytes& bytes) {
  put(bytes, 124, crc_by_definition(std::span(bytes).first(124)));
}

TEST(Calibration, LiesWhereTheProtocolSays) {
  const auto bytes = bytes_of(example());
  EXPECT_EQ(bytes[0], 'O');
  EXPECT_EQ(bytes[6], 128);
  EXPECT_EQ(bytes[8], 'L');
  EXPECT_EQ(get<std::uint32_t>(bytes, 24), 20260131u);
  EXPECT_EQ(get<float>(bytes, 28 + 16), 0.025f);
  EXPECT_EQ(get<float>(bytes, 28 + 16 * 3 + 12), 400);
  EXPECT_EQ(get<float>(bytes, 92), 0.002f);
  EXPECT_EQ(get<float>(bytes, 104), 0.5f);
  EXPECT_EQ(get<float>(bytes, 120), 20);
  EXPECT_EQ(crc_by_definition(std::array<std::uint8_t, 9>{'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0xcbf43926u);
  EXPECT_EQ(get<std::uint32_t>(bytes, 124), crc_by_definition(std::span(bytes).first(124)));
}

TEST(Calibration, ReadsBackWhatItWrote) {
  const auto bytes = bytes_of(example());
  const auto c = parse_calibration(bytes);
  EXPECT_EQ(c.serial, "LAB-0001");
  EXPECT_EQ(c.track[2].deg_per_count, -0.75f);
  EXPECT_EQ(bytes_of(c), bytes);
}

TEST(Calibration, EveryFlippedBitIsNoticed) {
  const auto good = bytes_of(example());
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    auto bad = good;
    bad[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    EXPECT_THROW(parse_calibration(bad), CalibrationError) << "bit " << bit;
  }
}

/// With a correct CRC, so that only the rule itself refuses them.
TEST(Calibration, RefusesNumbersThatMeanNothing) {
  const auto message = [](std::size_t at, float value) -> std::string {
    auto bytes = bytes_of(example());
    put(bytes, at, value);
    seal(bytes);
    try {
      parse_calibration(bytes);
    } catch (const CalibrationError& error) {
      return error.what();
    }
    return "taken";
  };
  for (std::size_t at = 28; at < 124; at += 4) {
    EXPECT_NE(message(at, std::nanf("")).find("byte " + std::to_string(at)), std::string::npos);
    EXPECT_NE(message(at, std::numeric_limits<float>::infinity()), "taken");
  }
  for (const std::size_t at : {28, 32, 92, 100, 108}) EXPECT_NE(message(at, 0), "taken") << at;
  for (const std::size_t at : {40, 108}) EXPECT_NE(message(at, -1), "taken") << at;
  for (const std::size_t at : {36, 40, 96, 104}) EXPECT_EQ(message(at, 0), "taken") << at;
  const auto whole = bytes_of(example());
  EXPECT_THROW(parse_calibration(std::span(whole).first(127)), CalibrationError);
  Calibration blank = example();
  blank.serial = "two words";
  EXPECT_THROW(bytes_of(blank), CalibrationError);
}

TEST(Calibration, AnyRecordWithAFittingCrcIsTakenOrRefusedWhole) {
  std::mt19937 generator(3);
  int taken = 0;
  for (int i = 0; i < 100'000; ++i) {
    auto bytes = bytes_of(example());
    for (int k = 0; k < 2; ++k) bytes[generator() % 124] = static_cast<std::uint8_t>(generator());
    seal(bytes);
    try {
      EXPECT_EQ(bytes_of(parse_calibration(bytes)), bytes);
      ++taken;
    } catch (const CalibrationError&) {
    }
  }
  EXPECT_GT(taken, 50'000);
}

/// An instrument that is only turned is not fed, whatever its sensor reports.
TEST(Calibration, TakesTheCrossTalkOut) {
  TrackCalibration t{0.02f, 0.5f, 0.004f, 0};
  const double turned_counts = 200, seen_counts = 0.004 * 100 / 0.02;
  EXPECT_NEAR(insertion_mm(t, seen_counts, turned_counts), 0, 1e-6);
  EXPECT_NEAR(roll_deg(t, turned_counts), 100, 1e-6);
  EXPECT_NEAR(insertion_mm(t, seen_counts + 50, turned_counts), 1, 1e-6);
}

}  // namespace
}  // namespace ostium::device
