#pragma once
/// The lines of a sweep's table.
#include "app/commands/sweep/plan.h"
#include "app/session/run/play.h"

namespace ostium::app {

std::string heading(const SweepGrid& grid);
std::string line_of(const SweepGrid& grid, std::size_t run, const ScriptedRun& scripted, const PlayReport& report);
/// A line for a run that could not be made, as its vessel cannot be built, or that threw: one person whose artery has
/// no room for the lesion must not end a sweep over a thousand people.
std::string line_without_result(const SweepGrid& grid, std::size_t run, const std::string& why);
/// Whether a line (without its end) begins with what that run is of, and has as many fields as the heading.
bool is_line_of(const SweepGrid& grid, std::size_t run, const std::string& line);
/// Whether a line is one of those.
bool has_no_result(const std::string& line);
/// The beginning of such a line, up to its reason.
std::string without_end(const std::string& line);

}  // namespace ostium::app
