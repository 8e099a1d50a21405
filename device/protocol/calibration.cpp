#include "device/protocol/calibration.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "device/protocol/bytes.h"

namespace ostium::device {

namespace {

constexpr std::array<std::uint8_t, 4> magic{'O', 'S', 'T', 'C'};
constexpr std::size_t crc_at = 124, serial_at = 8, serial_bytes = 16;
constexpr std::uint16_t record_version = 1;

std::uint32_t crc_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32(0, bytes.data(), crc_at));
}

[[noreturn]] void refuse(std::size_t at, const std::string& what, const std::string& cure) {
  throw CalibrationError("calibration record, byte " + std::to_string(at) + ": " + what + "; " + cure);
}

const char* const calibrate_again = "calibrate the box again";

/// Reads or writes every number of a record: one list of positions for both.
template <class Record, class Number>
void each_number(Record& c, Number number) {
  for (std::size_t k = 0; k < 4; ++k) {
    auto& t = c.track[k];
    const std::size_t at = 28 + 16 * k;
    number(at, t.mm_per_count), number(at + 4, t.deg_per_count);
    number(at + 8, t.cross_talk_mm_deg), number(at + 12, t.before_introducer_mm);
  }
  number(92, c.atm_per_count), number(96, c.pressure_offset_atm);
  number(100, c.mL_s_per_count), number(104, c.flow_offset_mL_s);
  for (std::size_t k = 0; k < 4; ++k) number(108 + 4 * k, c.clamp_full_scale_N[k]);
}

void check_scale(std::size_t at, float value, const char* name) {
  if (value == 0) refuse(at, std::string(name) + " is 0, so its counts would mean nothing", calibrate_again);
}

void check(const Calibration& c) {
  each_number(c, [](std::size_t at, float value) {
    if (!std::isfinite(value)) refuse(at, "not a finite number", calibrate_again);
  });
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = 28 + 16 * k;
    check_scale(at, c.track[k].mm_per_count, "mm per count");
    check_scale(at + 4, c.track[k].deg_per_count, "degrees per count");
    if (c.track[k].before_introducer_mm < 0)
      refuse(at + 12, "the station's position is negative", "measure how far it lies outside the introducer");
    if (!(c.clamp_full_scale_N[k] > 0)) refuse(108 + 4 * k, "clamp full scale must be above 0 N", calibrate_again);
  }
  check_scale(92, c.atm_per_count, "pressure gain");
  check_scale(100, c.mL_s_per_count, "flow gain");
  if (c.serial.size() > serial_bytes ||
      !std::all_of(c.serial.begin(), c.serial.end(), [](char x) { return x > ' ' && x <= '~'; }))
    refuse(serial_at, "the serial is not up to 16 printable characters without blanks", "give the box a serial number");
}

}  // namespace

Calibration parse_calibration(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != calibration_bytes)
    refuse(0, std::to_string(bytes.size()) + " bytes where 128 are expected", "update the box's firmware");
  if (!std::equal(magic.begin(), magic.end(), bytes.begin()))
    refuse(0, "does not begin with OSTC: the box has never been calibrated", "run its calibration");
  if (const auto v = get<std::uint16_t>(bytes, 4); v != record_version)
    refuse(4, "version " + std::to_string(v) + " where 1 is expected", "update Ostium or the box's firmware");
  if (const auto n = get<std::uint16_t>(bytes, 6); n != calibration_bytes)
    refuse(6, "length " + std::to_string(n) + " where 128 is expected", calibrate_again);
  if (get<std::uint32_t>(bytes, crc_at) != crc_of(bytes)) refuse(crc_at, "the CRC does not fit", calibrate_again);

  Calibration c;
  const auto serial = bytes.subspan(serial_at, serial_bytes);
  const auto end = std::find(serial.begin(), serial.end(), 0);
  if (!std::all_of(end, serial.end(), [](std::uint8_t x) { return x == 0; }))
    refuse(serial_at, "the serial goes on behind its end", calibrate_again);
  c.serial.assign(serial.begin(), end);
  c.date = get<std::uint32_t>(bytes, 24);
  each_number(c, [&](std::size_t at, float& value) { value = get<float>(bytes, at); });
  check(c);
  return c;
}

std::array<std::uint8_t, calibration_bytes> bytes_of(const Calibration& c) {
  check(c);
  std::array<std::uint8_t, calibration_bytes> bytes{};
  std::copy(magic.begin(), magic.end(), bytes.begin());
  put<std::uint16_t>(bytes, 4, record_version);
  put<std::uint16_t>(bytes, 6, calibration_bytes);
  std::copy(c.serial.begin(), c.serial.end(), bytes.begin() + serial_at);
  put(bytes, 24, c.date);
  each_number(c, [&](std::size_t at, float value) { put(bytes, at, value); });
  put(bytes, crc_at, crc_of(bytes));
  return bytes;
}

double insertion_mm(const TrackCalibration& t, double insertion_counts, double roll_counts) {
  return t.mm_per_count * insertion_counts - t.cross_talk_mm_deg * roll_deg(t, roll_counts);
}

double roll_deg(const TrackCalibration& t, double roll_counts) { return t.deg_per_count * roll_counts; }

double pressure_atm(const Calibration& c, std::int16_t counts) {
  return double(c.atm_per_count) * counts + c.pressure_offset_atm;
}

double flow_mL_s(const Calibration& c, std::int16_t counts) {
  return double(c.mL_s_per_count) * counts + c.flow_offset_mL_s;
}

}  // namespace ostium::device
