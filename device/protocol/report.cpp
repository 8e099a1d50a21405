#include "device/protocol/report.h"

#include "device/protocol/bytes.h"

namespace ostium::device {

namespace {

constexpr std::uint8_t in_type = 0x01, out_type = 0x81, brake_type = 0x82;
constexpr std::uint16_t status_bits = 0b11111, out_flag_bits = 0b11;

Flaw first_flaw(std::span<const std::uint8_t> bytes, std::size_t length, std::uint8_t type) {
  if (bytes.empty()) return Flaw::length;
  if (bytes[0] != type) return Flaw::type;
  if (bytes.size() != length) return Flaw::length;
  if (bytes[1] != device_protocol_version) return Flaw::version;
  return Flaw::none;
}

bool is_brake_report(std::span<const std::uint8_t> bytes) { return !bytes.empty() && bytes[0] == brake_type; }

/// What ends an OUT report of either type: flags, and two bytes of zeros.
void put_flags(std::span<std::uint8_t> bytes, const OutReport& r) {
  put<std::uint16_t>(bytes, bytes.size() - 4, static_cast<std::uint16_t>(r.arm | r.identify << 1));
}

}  // namespace

Flaw flaw_of_in_report(std::span<const std::uint8_t> bytes) {
  if (const Flaw flaw = first_flaw(bytes, in_report_bytes, in_type); flaw != Flaw::none) return flaw;
  if (get<std::uint16_t>(bytes, 2) & ~status_bits) return Flaw::reserved_bits;
  for (std::size_t k = 0; k < 4; ++k)
    if (bytes[52 + k] > static_cast<std::uint8_t>(Tool::second_wire)) return Flaw::tool;
  return Flaw::none;
}

Flaw flaw_of_out_report(std::span<const std::uint8_t> bytes) {
  const bool brakes = is_brake_report(bytes);
  const std::size_t length = brakes ? brake_report_bytes : out_report_bytes;
  if (const Flaw flaw = first_flaw(bytes, length, brakes ? brake_type : out_type); flaw != Flaw::none) return flaw;
  if ((get<std::uint16_t>(bytes, length - 4) & ~out_flag_bits) || get<std::uint16_t>(bytes, length - 2) != 0)
    return Flaw::reserved_bits;
  return Flaw::none;
}

std::optional<InReport> parse_in_report(std::span<const std::uint8_t> bytes) {
  if (flaw_of_in_report(bytes) != Flaw::none) return {};
  const auto status = get<std::uint16_t>(bytes, 2);
  InReport r;
  r.armed = status & 1, r.watchdog = status & 2, r.emergency_stop = status & 4, r.over_temperature = status & 8;
  r.calibrated = status & 16;
  r.sequence = get<std::uint32_t>(bytes, 4);
  r.time_us = get<std::uint32_t>(bytes, 8);
  r.overruns = get<std::uint16_t>(bytes, 12);
  r.last_out_sequence = get<std::uint16_t>(bytes, 14);
  for (std::size_t k = 0; k < 4; ++k) {
    r.insertion[k] = get<std::int32_t>(bytes, 16 + 4 * k);
    r.roll[k] = get<std::int32_t>(bytes, 32 + 4 * k);
    r.quality[k] = bytes[48 + k];
    r.tool[k] = static_cast<Tool>(bytes[52 + k]);
  }
  r.pressure = get<std::int16_t>(bytes, 56);
  r.flow = get<std::int16_t>(bytes, 58);
  r.pedals = get<std::uint16_t>(bytes, 60);
  r.age_of_last_out_ms = get<std::uint16_t>(bytes, 62);
  return r;
}

std::optional<OutReport> parse_out_report(std::span<const std::uint8_t> bytes) {
  if (flaw_of_out_report(bytes) != Flaw::none) return {};
  const auto flags = get<std::uint16_t>(bytes, bytes.size() - 4);
  OutReport r;
  r.sequence = get<std::uint16_t>(bytes, 2);
  for (std::size_t k = 0; k < 4; ++k) r.clamp[k] = get<std::uint16_t>(bytes, 4 + 2 * k);
  if (is_brake_report(bytes)) {
    r.rotary.emplace();
    for (std::size_t k = 0; k < 4; ++k) (*r.rotary)[k] = get<std::uint16_t>(bytes, 12 + 2 * k);
  }
  r.arm = flags & 1, r.identify = flags & 2;
  return r;
}

std::array<std::uint8_t, in_report_bytes> bytes_of(const InReport& r) {
  std::array<std::uint8_t, in_report_bytes> bytes{in_type, device_protocol_version};
  put<std::uint16_t>(bytes, 2,
                     static_cast<std::uint16_t>(r.armed | r.watchdog << 1 | r.emergency_stop << 2 |
                                                r.over_temperature << 3 | r.calibrated << 4));
  put(bytes, 4, r.sequence);
  put(bytes, 8, r.time_us);
  put(bytes, 12, r.overruns);
  put(bytes, 14, r.last_out_sequence);
  for (std::size_t k = 0; k < 4; ++k) {
    put(bytes, 16 + 4 * k, r.insertion[k]);
    put(bytes, 32 + 4 * k, r.roll[k]);
    bytes[48 + k] = r.quality[k];
    bytes[52 + k] = static_cast<std::uint8_t>(r.tool[k]);
  }
  put(bytes, 56, r.pressure);
  put(bytes, 58, r.flow);
  put(bytes, 60, r.pedals);
  put(bytes, 62, r.age_of_last_out_ms);
  return bytes;
}

std::array<std::uint8_t, out_report_bytes> bytes_of(const OutReport& r) {
  std::array<std::uint8_t, out_report_bytes> bytes{out_type, device_protocol_version};
  put(bytes, 2, r.sequence);
  for (std::size_t k = 0; k < 4; ++k) put(bytes, 4 + 2 * k, r.clamp[k]);
  put_flags(bytes, r);
  return bytes;
}

std::array<std::uint8_t, brake_report_bytes> brake_bytes_of(const OutReport& r) {
  std::array<std::uint8_t, brake_report_bytes> bytes{brake_type, device_protocol_version};
  put(bytes, 2, r.sequence);
  const auto& rotary = r.rotary ? *r.rotary : r.clamp;
  for (std::size_t k = 0; k < 4; ++k) put(bytes, 4 + 2 * k, r.clamp[k]), put(bytes, 12 + 2 * k, rotary[k]);
  put_flags(bytes, r);
  return bytes;
}

}  // namespace ostium::device
