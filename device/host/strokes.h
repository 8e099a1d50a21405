#pragma once
/// From movements in the box to movements of the instruments: which tools are there, where their tips are, and what to
/// do when the box's travel runs out.
///
/// A tool that appears at a station has its tip there. It goes on being that instrument, seen or lost, until it is
/// drawn out as far as it came in; the next one to appear is a new instrument (an exchange).
///
/// The box follows some 30 cm. A tool pushed to the end of that, or drawn back to its beginning while the instrument is
/// deeper than the tool, pauses the simulation: the picture fades, the operator draws back (or pushes forward) by half
/// the travel at least and holds still, and it resumes with every instrument where it was.
#include <array>
#include <cstdint>

#include "device/host/tracking.h"

namespace ostium::device {

struct StrokeSettings {
  double travel_mm = 300;  ///< of a tool's tip beyond the introducer
  double margin_mm = 5;    ///< at both ends of the travel, and of the station for a tool drawn out
  double half_mm = 150;    ///< to be gone past before it resumes
  double still_mm = 1;     ///< a hand that stays within this
  double still_s = 0.3;    ///< for so long is still
  double fade_s = 0.25;    ///< of the picture, out or in
};

enum class ToolPresence : std::uint8_t { absent, seen, lost };

/// Why the simulation stands.
enum class Pause : std::uint8_t { none, travel_full, travel_empty };

struct StrokeTool {
  ToolPresence sight = ToolPresence::absent;
  double in_box_mm = 0;        ///< of the tool's tip beyond the introducer; negative: outside
  double inserted_mm = 0;      ///< of the instrument's; ahead of the former by the strokes taken
  double came_in_mm = 0;       ///< where its tip was first seen
  std::uint32_t arrivals = 0;  ///< how many instruments this one is the last of
};

struct StrokeState {
  std::array<StrokeTool, tools> tool{};
  Pause pause = Pause::none;
  Tool paused_by = Tool::none;
  double still_from_mm = 0, still_for_s = 0;  ///< while paused
  double picture = 1;                         ///< brightness, 0 to 1
};

/// What the instruments do over one report; all zero while paused.
struct InstrumentMovement {
  double advance_mm = 0, turn_deg = 0;
};

/// Pure: the same movements give the same.
std::array<InstrumentMovement, tools> follow(const StrokeSettings& settings, const Movements& movements,
                                             StrokeState& state);

/// The tool's tip, and that of its instrument, are at the introducer now. Asserts tool != Tool::none.
void zero(StrokeState& state, Tool tool);

}  // namespace ostium::device
