#pragma once
/// The lines of a sweep's table.
#include "app/commands/sweep/plan.h"
#include "app/session/run/play.h"

namespace ostium::app {

std::string heading(const Sweep& sweep);
std::string line_of(const SweepTask& task, const ScriptedRun& run, const PlayReport& report);
/// Of a run whose vessel cannot be built: one person whose artery has no room for a lesion must not end a sweep over a
/// thousand.
std::string line_without_vessel(const SweepTask& task, const std::string& why);

}  // namespace ostium::app
