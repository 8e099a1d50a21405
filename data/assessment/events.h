#pragma once
/// Events of a run. events.def is the one list of them: a new event is a row there and the code that says it.
#include <string>
#include <vector>

namespace ostium::data {

/// A recording keeps the number.
enum class EventCode : int {
#define OSTIUM_EVENT(name, severity, value, definition) name,
#include "data/assessment/events.def"
#undef OSTIUM_EVENT
};

/// Of errors in handling; what happens by itself, or is meant, has none.
enum class Severity { none, error, critical };
const char* severity_name(Severity severity);  ///< "error"; of none: ""

struct EventDefinition {
  EventCode code;
  std::string name;
  Severity severity;
  std::string value;  ///< what its value is, with the unit; empty: it has none
  std::string definition;
};
const std::vector<EventDefinition>& event_definitions();
/// Null: a recording of a later version has an event that is not known here.
const EventDefinition* definition_of(EventCode code);

/// Above this the sum of wall forces on a tool is an event. An estimate: no limit is agreed on; peak forces that
/// vascular phantoms report for novices are of this order.
inline constexpr double wall_force_limit_N = 1.0;
inline constexpr double wall_force_cut_off_Hz = 10;  ///< of the first-order low pass that forces are judged behind

/// So long a tip is in another branch of the tree before it counts as having come there, s.
inline constexpr double tip_settles_s = 0.3;

/// Flow behind the lesion below this share of what the muscle needs counts as none.
inline constexpr double occluded_share = 0.05;

/// Concentration over that of the undiluted, at which contrast counts as filling the ostium and as seen at the
/// landmark.
inline constexpr double filled_share = 0.5, seen_share = 0.15;

}  // namespace ostium::data
