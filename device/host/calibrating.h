#pragma once
/// Computes a calibration from the counts during a movement of known size. Each function throws CalibrationError for
/// implausible counts.
#include <cstdint>

#include "device/protocol/calibration.h"

namespace ostium::device {

/// The instrument was moved by `length_mm` into the patient without turning.
TrackCalibration with_length(TrackCalibration track, std::int64_t insertion_counts, double length_mm);

/// The instrument was turned by `turns`, clockwise as seen from the hub, without moving along. Call after with_length:
/// any insertion the sensor shows is cross-talk.
TrackCalibration with_turns(TrackCalibration track, std::int64_t insertion_counts, std::int64_t roll_counts,
                            double turns);

/// Mean counts with the indeflator open to the air; mean counts while it shows `atm`.
Calibration with_pressure_zero(Calibration calibration, double mean_counts);
Calibration with_pressure(Calibration calibration, double mean_counts, double atm);

/// Mean counts without flow; the integral of counts over time (s) while `volume_mL` left the syringe.
Calibration with_flow_zero(Calibration calibration, double mean_counts);
Calibration with_volume(Calibration calibration, double count_seconds, double elapsed_s, double volume_mL);

}  // namespace ostium::device
