#pragma once
/// Control requests of the box: vendor requests to its interface. `value` is wValue.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ostium::device {

enum class Request : std::uint8_t {
  info = 1,            ///< in, 10 bytes: BoxInfo; 8 of a box without abilities
  read_calibration,    ///< in, 128 bytes
  write_calibration,   ///< out, 128 bytes, stored temporarily; value = calibration_key, only while disarmed
  commit_calibration,  ///< activates the written record if it is valid; value = calibration_key, only while disarmed
  zero,                ///< resets the counts of the tracks in value (bit k: track k)
  watchdog_time,       ///< value = 10 .. 500 ms
  rate,                ///< value = 125, 250, 500 or 1000 Hz
  statistics,          ///< in, 16 bytes: BoxStatistics
};
inline constexpr std::uint16_t calibration_key = 0x5443;

struct BoxInfo {
  std::uint8_t version = 0, tracks = 0;
  std::uint16_t firmware = 0, rate_Hz = 0, watchdog_ms = 0;
  bool separate_brakes = false;  ///< takes OUT reports of type 0x82 (bit 0 of its abilities)
};

struct BoxStatistics {
  std::uint32_t sent = 0, taken = 0, ignored = 0;  ///< reports: IN sent, OUT accepted, OUT that broke a rule
  std::uint32_t watchdog_releases = 0;
};

inline constexpr std::size_t info_bytes = 10, least_info_bytes = 8, statistics_bytes = 16;

std::array<std::uint8_t, info_bytes> bytes_of(const BoxInfo& info);
std::array<std::uint8_t, statistics_bytes> bytes_of(const BoxStatistics& statistics);
/// Empty if there are too few bytes.
std::optional<BoxInfo> parse_info(std::span<const std::uint8_t> bytes);
/// Empty if the length is wrong.
std::optional<BoxStatistics> parse_statistics(std::span<const std::uint8_t> bytes);

class Port;
/// Empty if the box refused, or answered too little.
std::optional<BoxInfo> read_info(Port& port);
/// The record as the box returns it, complete or not; parse_calibration checks it.
std::vector<std::uint8_t> read_calibration(Port& port);
/// Writes and commits the record. False: the box refused, because it is armed or the record is invalid.
bool write_calibration(Port& port, std::span<const std::uint8_t> record);

}  // namespace ostium::device
