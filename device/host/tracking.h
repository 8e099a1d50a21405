#pragma once
/// From counts to movements: how far each tool went since the report before.
///
/// Counts are absolute and wrap; only their differences count, so a report that never came loses no movement. A station
/// that sees its tool badly, another tool or none says nothing of movement until it has seen the same tool well twice.
#include <array>
#include <cstddef>
#include <cstdint>

#include "device/protocol/calibration.h"
#include "device/protocol/report.h"

namespace ostium::device {

inline constexpr std::size_t tools = 4;  ///< Tool::guide .. Tool::second_wire

/// Place of a tool in an array of all four; not of Tool::none.
constexpr std::size_t index_of(Tool tool) { return static_cast<std::size_t>(tool) - 1; }

/// A tool is lost when the quality falls below the first, and found again at the second.
inline constexpr std::uint8_t lost_below_quality = 24, found_from_quality = 48;

/// One tool over one report.
struct ToolMovement {
  bool seen = false;                ///< well enough to follow
  double advance_mm = 0;            ///< positive into the patient
  double turn_deg = 0;              ///< positive clockwise as seen from the hub: right-handed about the advance
  double before_introducer_mm = 0;  ///< of the station that sees it
};

struct Movements {
  std::array<ToolMovement, tools> tool;
  double elapsed_s = 0;            ///< of the box's clock; 0 in a first report
  std::uint32_t lost_reports = 0;  ///< between the report before and this one, by sequence
  bool repeated = false;           ///< the same report again: nothing moved, no time went by
  bool restarted = false;          ///< first report, or the box began anew: nothing can be said of movement
};

struct TrackMemory {
  Tool tool = Tool::none;  ///< none: not seen well
  std::int32_t insertion = 0, roll = 0;
};

struct TrackingState {
  bool begun = false;  ///< false after an unplug, too
  std::uint32_t sequence = 0, time_us = 0;
  std::array<TrackMemory, 4> track{};
};

/// Pure: the same reports give the same movements. A tool that several stations see is followed by the one of highest
/// quality, the first of equals; each station differences its own counts, so that a change of station does not jump.
Movements movements(const Calibration& calibration, const InReport& report, TrackingState& state);

}  // namespace ostium::device
