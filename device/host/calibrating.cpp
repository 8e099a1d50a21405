#include "device/host/calibrating.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace ostium::device {

namespace {

constexpr double least_counts = 100;  // minimum for a scale: 1 % accuracy is required

constexpr const char* sees = "does the sensor see the instrument?";

void require(double counts, const char* what, const char* doubt) {
  if (std::abs(counts) < least_counts)
    throw CalibrationError(
        fmt::format("{} moved by {:.0f} counts only; at least 100 are needed: {}", what, counts, doubt));
}

}  // namespace

TrackCalibration with_length(TrackCalibration t, std::int64_t insertion_counts, double length_mm) {
  require(static_cast<double>(insertion_counts), "insertion", sees);
  t.mm_per_count = static_cast<float>(length_mm / static_cast<double>(insertion_counts));
  return t;
}

TrackCalibration with_turns(TrackCalibration t, std::int64_t insertion_counts, std::int64_t roll_counts, double turns) {
  require(static_cast<double>(roll_counts), "roll", sees);
  t.deg_per_count = static_cast<float>(360 * turns / static_cast<double>(roll_counts));
  t.cross_talk_mm_deg = static_cast<float>(t.mm_per_count * static_cast<double>(insertion_counts) / (360 * turns));
  return t;
}

Calibration with_pressure_zero(Calibration c, double mean_counts) {
  c.pressure_offset_atm = static_cast<float>(-c.atm_per_count * mean_counts);
  return c;
}

Calibration with_pressure(Calibration c, double mean_counts, double atm) {
  const double zero_counts = -c.pressure_offset_atm / c.atm_per_count;
  require(mean_counts - zero_counts, "pressure", "does the gauge show it?");
  c.atm_per_count = static_cast<float>(atm / (mean_counts - zero_counts));
  return with_pressure_zero(c, zero_counts);
}

Calibration with_flow_zero(Calibration c, double mean_counts) {
  c.flow_offset_mL_s = static_cast<float>(-c.mL_s_per_count * mean_counts);
  return c;
}

Calibration with_volume(Calibration c, double count_seconds, double elapsed_s, double volume_mL) {
  const double zero_counts = -c.flow_offset_mL_s / c.mL_s_per_count;
  const double flowed = count_seconds - zero_counts * elapsed_s;
  require(flowed, "flow", "does the syringe inject?");
  c.mL_s_per_count = static_cast<float>(volume_mL / flowed);
  return with_flow_zero(c, zero_counts);
}

}  // namespace ostium::device
