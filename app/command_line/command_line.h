#pragma once
/// Parses the command line and runs the command it names.
#include "app/command_line/command.h"

namespace ostium::app {

/// Parses the arguments and runs the program or its subcommand. Returns the exit code; prints help, usage errors and
/// exceptions thrown by commands.
int run_command_line(const Command& program, int argc, char** argv);

}  // namespace ostium::app
