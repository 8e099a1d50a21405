#include "device/transport/control.h"

#include "device/protocol/bytes.h"
#include "device/protocol/calibration.h"
#include "device/transport/port.h"

namespace ostium::device {

std::array<std::uint8_t, info_bytes> bytes_of(const BoxInfo& i) {
  std::array<std::uint8_t, info_bytes> bytes{i.version, i.tracks};
  put(bytes, 2, i.firmware), put(bytes, 4, i.rate_Hz), put(bytes, 6, i.watchdog_ms);
  put<std::uint16_t>(bytes, 8, i.separate_brakes);
  return bytes;
}

std::array<std::uint8_t, statistics_bytes> bytes_of(const BoxStatistics& s) {
  std::array<std::uint8_t, statistics_bytes> bytes{};
  put(bytes, 0, s.sent), put(bytes, 4, s.taken), put(bytes, 8, s.ignored), put(bytes, 12, s.watchdog_releases);
  return bytes;
}

std::optional<BoxInfo> parse_info(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < least_info_bytes) return {};
  const bool tells_abilities = bytes.size() >= info_bytes;
  return BoxInfo{bytes[0],
                 bytes[1],
                 get<std::uint16_t>(bytes, 2),
                 get<std::uint16_t>(bytes, 4),
                 get<std::uint16_t>(bytes, 6),
                 tells_abilities && (get<std::uint16_t>(bytes, 8) & 1)};
}

std::optional<BoxStatistics> parse_statistics(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != statistics_bytes) return {};
  return BoxStatistics{get<std::uint32_t>(bytes, 0), get<std::uint32_t>(bytes, 4), get<std::uint32_t>(bytes, 8),
                       get<std::uint32_t>(bytes, 12)};
}

std::optional<BoxInfo> read_info(Port& port) {
  std::array<std::uint8_t, info_bytes> bytes{};
  return parse_info(std::span(bytes).first(port.read(static_cast<std::uint8_t>(Request::info), bytes).value_or(0)));
}

std::vector<std::uint8_t> read_calibration(Port& port) {
  std::vector<std::uint8_t> record(calibration_bytes);
  record.resize(port.read(static_cast<std::uint8_t>(Request::read_calibration), record).value_or(0));
  return record;
}

bool write_calibration(Port& port, std::span<const std::uint8_t> record) {
  return port.write(static_cast<std::uint8_t>(Request::write_calibration), calibration_key, record) &&
         port.write(static_cast<std::uint8_t>(Request::commit_calibration), calibration_key);
}

}  // namespace ostium::device
