#pragma once
#include "app/commands/command.h"

namespace ostium {

/// `ostium` with all its subcommands.
Command program();

}  // namespace ostium
