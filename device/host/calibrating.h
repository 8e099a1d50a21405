#pragma once
/// A calibration from what was done at the box: counts that went by while something of known size was done. Each throws
/// CalibrationError if the counts cannot be that.
#include <cstdint>

#include "device/protocol/calibration.h"

namespace ostium::device {

/// An instrument was moved by `length_mm` into the patient, without turning it.
TrackCalibration with_length(TrackCalibration track, std::int64_t insertion_counts, double length_mm);

/// An instrument was turned by `turns`, clockwise as seen from the hub, its length held. After with_length: what the
/// sensor shows of insertion is the cross-talk.
TrackCalibration with_turns(TrackCalibration track, std::int64_t insertion_counts, std::int64_t roll_counts,
                            double turns);

/// Mean counts while the indeflator is open to the air; while it shows `atm`.
Calibration with_pressure_zero(Calibration calibration, double mean_counts);
Calibration with_pressure(Calibration calibration, double mean_counts, double atm);

/// Mean counts while nothing flows; sum of counts times seconds while `volume_mL` went out of the syringe.
Calibration with_flow_zero(Calibration calibration, double mean_counts);
Calibration with_volume(Calibration calibration, double count_seconds, double elapsed_s, double volume_mL);

}  // namespace ostium::device
