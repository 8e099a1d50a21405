#pragma once
/// Converts counts to movements: how far each tool moved since the previous report.
///
/// Counts are absolute and wrap; only differences are used, so a lost report loses no movement. A station that sees its
/// tool poorly, another tool or none reports no movement until it has seen the same tool well twice.
#include <array>
#include <cstddef>
#include <cstdint>

#include "device/protocol/calibration.h"
#include "device/protocol/report.h"

namespace ostium::device {

inline constexpr std::size_t tools = 4;  ///< Tool::guide .. Tool::second_wire

/// Index of a tool in an array of all four; not for Tool::none.
constexpr std::size_t index_of(Tool tool) { return static_cast<std::size_t>(tool) - 1; }

/// A tool is lost when its quality falls below the first value, and found again at the second.
inline constexpr std::uint8_t lost_below_quality = 24, found_from_quality = 48;

/// One tool's movement over one report.
struct ToolMovement {
  bool seen = false;                ///< well enough to follow
  double advance_mm = 0;            ///< positive into the patient
  double turn_deg = 0;              ///< positive clockwise as seen from the hub: right-handed about the advance
  double before_introducer_mm = 0;  ///< distance of the station that sees it from the introducer
};

struct Movements {
  std::array<ToolMovement, tools> tool;
  double elapsed_s = 0;            ///< by the box's clock; 0 in a first report
  std::uint32_t lost_reports = 0;  ///< lost since the previous report, by sequence number
  bool repeated = false;           ///< a duplicate report: no movement, no time
  bool restarted = false;          ///< first report, or the box restarted: no movement is known
};

struct TrackMemory {
  Tool tool = Tool::none;  ///< none: not seen well
  std::int32_t insertion = 0, roll = 0;
};

struct TrackingState {
  bool begun = false;  ///< also reset to false when unplugged
  std::uint32_t sequence = 0, time_us = 0;
  std::array<TrackMemory, 4> track{};
};

/// Pure: the same reports give the same movements. If several stations see a tool, the one of highest quality is used,
/// or the first of equals; each station differences its own counts, so switching stations causes no jump.
Movements movements(const Calibration& calibration, const InReport& report, TrackingState& state);

}  // namespace ostium::device
