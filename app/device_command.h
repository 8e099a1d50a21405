#pragma once
#include <string>

namespace ostium {

struct DeviceOptions {
  std::string serial;     ///< of the box; empty: the first that is found
  double seconds = 0;     ///< of `monitor`, `emulate`; 0: until Ctrl-C
  bool arm = false;       ///< `monitor` arms the clamps, open
  double push_N = 0;      ///< `monitor` arms them, and resists every push so
  bool emulator = false;  ///< `monitor` an emulated box in this process
  bool json = false;
  int port = 3240;        ///< of `emulate`
  bool any_host = false;  ///< `emulate` answers other machines too
  bool still = false;     ///< nobody moves the emulated tools
};

/// `ostium device list`: 0 if a box is there, else 1.
int device_list_command(const DeviceOptions& options);
/// `ostium device monitor`: 0 if reports came and none was lost, else 1.
int device_monitor_command(const DeviceOptions& options);

/// `ostium device emulate`: until Ctrl-C.
int device_emulate_command(const DeviceOptions& options);

}  // namespace ostium
