#pragma once
/// A box's calibration as text.
#include <string>

#include "device/tracking_box.h"

namespace ostium {

std::string to_json(const Calibration& calibration);
/// Throws LoadError.
Calibration read_calibration_record(const std::string& file);

}  // namespace ostium
