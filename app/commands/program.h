#pragma once
#include "app/command_line/command.h"

namespace ostium::app {

/// `ostium` with all its subcommands.
Command program();

}  // namespace ostium::app
