#pragma once
/// The signals of a run, recorded a hundred times a second, for metrics, display and debriefing; not needed for replay.
/// Each signal is one row in a table of signals.cpp: name, unit, description, function.
#include <string>
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

struct SignalDefinition {
  std::string name;  ///< "wire.tip_x_mm"
  std::string unit;  ///< "1" if dimensionless
  std::string definition;
};
/// The columns in order.
std::vector<SignalDefinition> signal_definitions(const SessionModel& model);

std::size_t signal_count(const SessionModel& model);
std::vector<std::string> signal_names(const SessionModel& model);
/// `row` has signal_count numbers. Does not allocate.
void put_signals(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                 const SessionReport& report, float* row);

}  // namespace ostium::app
