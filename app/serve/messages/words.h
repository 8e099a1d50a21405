#pragma once
/// Events as a person reads them.
#include <string>

#include "app/session/handling/session_event.h"
#include "app/session/operator/operator.h"

namespace ostium::app {

/// "wire: enters RCA", "guide: wall force high, 1.3 N"; empty: not for a timeline.
std::string words_of(const SessionEvent& event, const SessionModel& model, const ScriptPlan& plan);

/// "step", "event", "error", "critical" or "mark".
std::string kind_of(const SessionEvent& event);

}  // namespace ostium::app
