#pragma once
/// Control requests of the box: vendor requests to its interface. `value` is wValue.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ostium::device {

enum class Request : std::uint8_t {
  info = 1,            ///< in, 8 bytes: BoxInfo
  read_calibration,    ///< in, 128 bytes
  write_calibration,   ///< out, 128 bytes, kept aside; value = calibration_key, only disarmed
  commit_calibration,  ///< takes what was written if it is a valid record; value = calibration_key, only disarmed
  zero,                ///< counts of the tracks in value (bit k: track k) become 0
  watchdog_time,       ///< value = 10 .. 500 ms
  rate,                ///< value = 125, 250, 500 or 1000 Hz
  statistics,          ///< in, 16 bytes: BoxStatistics
};
inline constexpr std::uint16_t calibration_key = 0x5443;

struct BoxInfo {
  std::uint8_t version = 0, tracks = 0;
  std::uint16_t firmware = 0, rate_Hz = 0, watchdog_ms = 0;
};

struct BoxStatistics {
  std::uint32_t sent = 0, taken = 0, ignored = 0;  ///< reports: IN, OUT, OUT that broke a rule
  std::uint32_t watchdog_releases = 0;
};

inline constexpr std::size_t info_bytes = 8, statistics_bytes = 16;

std::array<std::uint8_t, info_bytes> bytes_of(const BoxInfo& info);
std::array<std::uint8_t, statistics_bytes> bytes_of(const BoxStatistics& statistics);
/// Nothing if the length is another.
std::optional<BoxInfo> parse_info(std::span<const std::uint8_t> bytes);
std::optional<BoxStatistics> parse_statistics(std::span<const std::uint8_t> bytes);

class Port;
/// The record as the box has it, or as much of it as it gives: parse_calibration looks at that.
std::vector<std::uint8_t> read_calibration(Port& port);
/// Written and committed. False: the box refused it, being armed or finding the record wrong.
bool write_calibration(Port& port, std::span<const std::uint8_t> record);

}  // namespace ostium::device
