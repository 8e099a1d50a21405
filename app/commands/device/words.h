#pragma once
#include "device/tracking_box.h"

namespace ostium {

/// As tables and JSON say them.
const char* words(Sight sight);
const char* words(Link link);
const char* words(PortTrouble trouble);
const char* words(Pause pause);

}  // namespace ostium
