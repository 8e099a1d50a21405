#pragma once
/// What a recording shows of a run a hundred times a second, for metrics, for people and for debriefing; not needed for
/// replay. A signal is one row in a table of signals.cpp: name, unit, what it is, how it is taken.
#include <string>
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

struct SignalDefinition {
  std::string name;  ///< "wire.tip_x_mm"
  std::string unit;  ///< "1": none
  std::string definition;
};
/// The columns, in their order.
std::vector<SignalDefinition> signal_definitions(const SessionModel& model);

std::size_t signal_count(const SessionModel& model);
std::vector<std::string> signal_names(const SessionModel& model);
/// `row` has signal_count numbers. Does not allocate.
void put_signals(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                 const SessionReport& report, float* row);

}  // namespace ostium::app
