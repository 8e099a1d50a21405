#pragma once
#include <optional>
#include <string>

namespace ostium {

struct CalibrateOptions {
  std::string serial;                         ///< of the box; empty: the first that is found
  std::string write;                          ///< a record as JSON, to be written into the box
  int track = 0;                              ///< 1 to 4: that length, turns, station and clamp belong to
  std::optional<double> length_mm, turns;     ///< done between two moments
  std::optional<double> station_mm, clamp_N;  ///< measured by hand
  bool pressure_zero = false, flow_zero = false;
  std::optional<double> pressure_atm, volume_mL;
  double seconds = 0;    ///< of a measurement; 0: until Enter
  bool dry_run = false;  ///< nothing is written into the box
};

/// `ostium device calibrate`: prints the record, as it is or becomes. Throws LoadError, CalibrationError.
int device_calibrate_command(const CalibrateOptions& options);

}  // namespace ostium
