#pragma once
/// From the command line to the command that it names.
#include "app/commands/command.h"

namespace ostium {

/// Parses what was typed and runs the program, or its subcommand. Returns the exit code; help, usage errors and what a
/// command throws are printed.
int run_command_line(const Command& program, int argc, char** argv);

}  // namespace ostium
