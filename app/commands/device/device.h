#pragma once
/// The subcommands of `ostium device`.
#include "app/command_line/command.h"

namespace ostium::app {

Command device_list_command();
Command device_monitor_command();
Command device_emulate_command();
Command device_calibrate_command();

/// Seconds of a monotonic clock.
double clock_s();

}  // namespace ostium::app
