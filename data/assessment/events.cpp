#include "data/assessment/events.h"

namespace ostium::data {

const std::vector<EventDefinition>& event_definitions() {
  static const std::vector<EventDefinition> all = {
#define OSTIUM_EVENT(name, severity, value, definition) {EventCode::name, #name, Severity::severity, value, definition},
#include "data/assessment/events.def"
#undef OSTIUM_EVENT
  };
  return all;
}

const EventDefinition* definition_of(EventCode code) {
  const auto at = static_cast<std::size_t>(code);
  return at < event_definitions().size() ? &event_definitions()[at] : nullptr;
}

const char* severity_name(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::critical ? "critical" : "";
}

}  // namespace ostium::data
