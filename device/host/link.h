#pragma once
/// The state of the connection to the box, as shown to the operator. Pure: time and events in, a state out.
#include <cstdint>
#include <string_view>

#include "device/protocol/report.h"

namespace ostium::device {

enum class Link : std::uint8_t {
  unplugged,
  silent,         ///< plugged in, but no valid report for silent_after_s
  wrong_version,  ///< uses another version of the protocol
  stopped,        ///< emergency stop or over-temperature
  running,
};

struct LinkState {
  bool plugged = false, heard = false, stopped = false, wrong_version = false;
  double quiet_s = 0;         ///< since the last valid report, or since it was plugged in
  std::uint64_t taken = 0;    ///< valid reports
  std::uint64_t ignored = 0;  ///< reports that broke a rule
};

inline constexpr double silent_after_s = 0.1;

void plugged_in(LinkState& state);
void unplugged(LinkState& state);
void time_passed(double elapsed_s, LinkState& state);

/// Parses the bytes of an IN report; returns it if it is valid.
std::optional<InReport> received(std::span<const std::uint8_t> bytes, LinkState& state);

Link link(const LinkState& state);

/// One line for the operator: the problem and its remedy. Empty while running.
std::string_view advice(Link link);

}  // namespace ostium::device
