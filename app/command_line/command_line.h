#pragma once
/// From the command line to the command that it names.
#include "app/command_line/command.h"

namespace ostium::app {

/// Parses what was typed and runs the program, or its subcommand. Returns the exit code; help, usage errors and what a
/// command throws are printed.
int run_command_line(const Command& program, int argc, char** argv);

}  // namespace ostium::app
