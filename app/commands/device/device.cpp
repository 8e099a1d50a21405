#include "app/commands/device/device.h"

#include <chrono>

namespace ostium::app {

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Command device_command() {
  Command device;
  device.name = "device", device.help = "The tracking box: look for it, watch it, calibrate it, emulate it";
  device.examples = {"ostium device list", "ostium device monitor --seconds 60"};
  device.subcommands = {device_list_command(), device_monitor_command(), device_emulate_command(),
                        device_calibrate_command()};
  return device;
}

}  // namespace ostium::app
