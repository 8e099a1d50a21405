#pragma once
/// Converts tool movements in the box to instrument movements: which tools are present, where their tips are, and what
/// happens when the box's travel runs out.
///
/// A tool that appears at a station has its tip there. It remains the same instrument, whether seen or lost, until it
/// is drawn out as far as it came in; the next tool to appear is a new instrument (an exchange).
///
/// The box tracks about 30 cm of travel. If a tool is pushed to the end of it, or drawn back to its beginning while the
/// instrument is still deeper, the simulation pauses: the picture fades, the operator draws the tool back (or pushes it
/// forward) by at least half the travel and holds still, and it resumes with every instrument where it was.
#include <array>
#include <cstdint>

#include "device/host/tracking.h"

namespace ostium::device {

struct StrokeSettings {
  double travel_mm = 300;  ///< of a tool's tip beyond the introducer
  double margin_mm = 5;    ///< at both ends of the travel, and at the station for a tool drawn out
  double half_mm = 150;    ///< position to pass before the simulation resumes
  double still_mm = 1;     ///< a hand within this distance
  double still_s = 0.3;    ///< for this long counts as still
  double fade_s = 0.25;    ///< time for the picture to fade out or in
};

enum class ToolPresence : std::uint8_t { absent, seen, lost };

/// Why the simulation is paused.
enum class Pause : std::uint8_t { none, travel_full, travel_empty };

struct StrokeTool {
  ToolPresence sight = ToolPresence::absent;
  double in_box_mm = 0;        ///< tip of the tool beyond the introducer; negative: outside
  double inserted_mm = 0;      ///< tip of the instrument; deeper by the strokes taken
  double came_in_mm = 0;       ///< where the tip was first seen
  std::uint32_t arrivals = 0;  ///< number of instruments so far
};

struct StrokeState {
  std::array<StrokeTool, tools> tool{};
  Pause pause = Pause::none;
  Tool paused_by = Tool::none;
  double still_from_mm = 0, still_for_s = 0;  ///< while paused
  double picture = 1;                         ///< brightness, 0 to 1
};

/// Movement of the instruments over one report; zero while paused.
struct InstrumentMovement {
  double advance_mm = 0, turn_deg = 0;
};

/// Pure: the same movements give the same result.
std::array<InstrumentMovement, tools> follow(const StrokeSettings& settings, const Movements& movements,
                                             StrokeState& state);

/// The tips of the tool and its instrument are at the introducer now. Asserts tool != Tool::none.
void zero(StrokeState& state, Tool tool);

}  // namespace ostium::device
