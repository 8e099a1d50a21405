#pragma once
/// The lines of a sweep's table.
#include "app/commands/sweep/plan.h"
#include "app/session/run/play.h"

namespace ostium::app {

std::string heading(const Sweep& sweep);
std::string line_of(const SweepTask& task, const ScriptedRun& run, const PlayReport& report);
/// A line for a run whose vessel cannot be built: a person whose artery has no room for the lesion must not end a sweep
/// over a thousand people.
std::string line_without_vessel(const SweepTask& task, const std::string& why);

}  // namespace ostium::app
