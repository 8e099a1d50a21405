#include "app/commands/device/words.h"

namespace ostium {

const char* words(Sight sight) { return sight == Sight::seen ? "seen" : sight == Sight::lost ? "LOST" : "absent"; }

const char* words(Link link) {
  constexpr const char* all[] = {"unplugged", "silent", "wrong version", "stopped", "running"};
  return all[static_cast<int>(link)];
}

const char* words(PortTrouble trouble) {
  constexpr const char* all[] = {"", "no access", "in use", "not a box", "stalled", "failing"};
  return all[static_cast<int>(trouble)];
}

const char* words(Pause pause) {
  return pause == Pause::none ? "" : pause == Pause::travel_full ? "travel full" : "travel empty";
}

}  // namespace ostium
