#include "app/commands/device/words.h"

namespace ostium::app {

const char* words(device::ToolPresence sight) {
  return sight == device::ToolPresence::seen ? "seen" : sight == device::ToolPresence::lost ? "LOST" : "absent";
}

const char* words(device::Link link) {
  constexpr const char* all[] = {"unplugged", "silent", "wrong version", "stopped", "running"};
  return all[static_cast<int>(link)];
}

const char* words(device::PortTrouble trouble) {
  constexpr const char* all[] = {"", "no access", "in use", "not a box", "stalled", "failing"};
  return all[static_cast<int>(trouble)];
}

const char* words(device::Pause pause) {
  return pause == device::Pause::none ? "" : pause == device::Pause::travel_full ? "travel full" : "travel empty";
}

}  // namespace ostium::app
