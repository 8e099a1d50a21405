#pragma once
/// The reports of the tracking box, protocol version 1: converts between bytes and values; little endian, raw counts.
/// No USB here.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace ostium::device {

inline constexpr std::size_t in_report_bytes = 64, out_report_bytes = 16, brake_report_bytes = 24;
inline constexpr std::uint8_t device_protocol_version = 1;

/// The kind of tool at a track's sensor station.
enum class Tool : std::uint8_t { none, guide, wire, shaft, second_wire };

/// One sample of the box.
struct InReport {
  bool armed = false, watchdog = false, emergency_stop = false, over_temperature = false, calibrated = false;
  std::uint32_t sequence = 0;  ///< incremented per sample; a gap means lost reports
  std::uint32_t time_us = 0;   ///< wraps in 71.6 min
  std::uint16_t overruns = 0;
  std::uint16_t last_out_sequence = 0;      ///< of the last OUT report that the box accepted
  std::array<std::int32_t, 4> insertion{};  ///< counts, positive into the patient
  std::array<std::int32_t, 4> roll{};       ///< counts, positive clockwise as seen from the hub
  std::array<std::uint8_t, 4> quality{};    ///< 0: no tool
  std::array<Tool, 4> tool{};
  std::int16_t pressure = 0;  ///< counts, signed: vacuum
  std::int16_t flow = 0;      ///< counts, negative: aspiration
  std::uint16_t pedals = 0;   ///< bit 0 fluoroscopy, bit 1 cine, the rest assigned by the host
  std::uint16_t age_of_last_out_ms = 0;
};

/// What the host asks of the box.
struct OutReport {
  std::uint16_t sequence = 0;
  std::array<std::uint16_t, 4> clamp{};  ///< 0: free
  bool arm = false, identify = false;
  /// Where pushing and turning have brakes of their own: that of turning; `clamp` is then that of pushing alone.
  std::optional<std::array<std::uint16_t, 4>> rotary = std::nullopt;
};

/// The first protocol rule that the bytes break.
enum class Flaw : std::uint8_t { none, type, length, version, reserved_bits, tool };

Flaw flaw_of_in_report(std::span<const std::uint8_t> bytes);
Flaw flaw_of_out_report(std::span<const std::uint8_t> bytes);

/// Empty if there is a flaw: the caller must ignore the whole report and count it. (Flaw::type alone may be a report of
/// a later protocol, and is no sign of damage.)
std::optional<InReport> parse_in_report(std::span<const std::uint8_t> bytes);
std::optional<OutReport> parse_out_report(std::span<const std::uint8_t> bytes);

std::array<std::uint8_t, in_report_bytes> bytes_of(const InReport& report);
/// Of a report for one brake a track; `rotary` is left out.
std::array<std::uint8_t, out_report_bytes> bytes_of(const OutReport& report);
/// Of one for two brakes a track, for a box whose info says that it has them (BoxInfo::separate_brakes). Without
/// `rotary` both are as `clamp` says.
std::array<std::uint8_t, brake_report_bytes> brake_bytes_of(const OutReport& report);

}  // namespace ostium::device
