#pragma once
/// Events of a run. events.def is the only list of them: a new event needs a row there and the code that reports it.
#include <string>
#include <vector>

namespace ostium::data {

/// A recording stores the number.
enum class EventCode : int {
#define OSTIUM_EVENT(name, severity, value, definition) name,
#include "data/assessment/events.def"
#undef OSTIUM_EVENT
};

/// How bad a handling error is; `none` for events that are not errors.
enum class Severity { none, error, critical };
const char* severity_name(Severity severity);  ///< "error"; "" for `none`

struct EventDefinition {
  EventCode code;
  std::string name;
  Severity severity;
  std::string value;  ///< what its value is, with the unit; empty if it has none
  std::string definition;
};
const std::vector<EventDefinition>& event_definitions();
/// Null if the code is unknown here: a recording of a later version.
const EventDefinition* definition_of(EventCode code);

/// A sum of wall forces on one tool above this is an event. An estimate: there is no agreed limit; vascular phantoms
/// report peak forces of this order for novices.
inline constexpr double wall_force_limit_N = 1.0;
inline constexpr double wall_force_cut_off_Hz = 10;  ///< of the first-order low pass on assessed forces
/// It is over once the force was below 0.8 of the limit for this long: longer than a beat, since each beat presses
/// anew.
inline constexpr double wall_force_over_s = 2;

/// A tip must be in another branch of the tree for this long before it counts as having entered it, s.
inline constexpr double tip_settles_s = 0.3;
/// In the branch that it was in before, for longer than a beat: with the heart a tip sways across a border.
inline constexpr double tip_returns_s = 1.5;

/// Flow distal to the lesion below this share of what the muscle needs counts as no flow.
inline constexpr double occluded_share = 0.05;

/// Concentration relative to undiluted contrast at which contrast counts as filling the ostium, and as seen at the
/// landmark.
inline constexpr double filled_share = 0.5, seen_share = 0.15;

}  // namespace ostium::data
