#pragma once
/// A box's calibration as text.
#include <string>

#include "device/host/tracking_box.h"

namespace ostium::app {

std::string to_json(const device::Calibration& calibration);
/// Throws LoadError.
device::Calibration read_calibration_record(const std::string& file);

}  // namespace ostium::app
