#pragma once
#include "device/host/tracking_box.h"

namespace ostium::app {

/// Texts for tables and JSON.
const char* words(device::ToolPresence sight);
const char* words(device::Link link);
const char* words(device::PortTrouble trouble);
const char* words(device::Pause pause);

}  // namespace ostium::app
