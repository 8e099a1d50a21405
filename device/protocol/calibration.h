#pragma once
/// The box's calibration record, 128 bytes little endian with a CRC-32: converts counts to lengths, angles, pressure,
/// flow and clamp levels.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace ostium::device {

inline constexpr std::size_t calibration_bytes = 128;

/// One sensor station.
struct TrackCalibration {
  float mm_per_count = 0.01f;      ///< not 0; negative if the sensor is mounted the other way round
  float deg_per_count = 0.1f;      ///< as above
  float cross_talk_mm_deg = 0;     ///< insertion that the sensor reports per degree when an instrument is only turned
  float before_introducer_mm = 0;  ///< distance of the station outside the introducer, >= 0
};

struct Calibration {
  std::string serial;      ///< up to 16 printable characters
  std::uint32_t date = 0;  ///< yyyymmdd in decimal; 0: unknown
  std::array<TrackCalibration, 4> track{};
  float atm_per_count = 0.001f, pressure_offset_atm = 0;
  float mL_s_per_count = 0.01f, flow_offset_mL_s = 0;
  std::array<float, 4> clamp_full_scale_N{10, 10, 10, 10};  ///< friction of a clamp at level 65535, > 0
};

/// A record that cannot be used: which byte, value found, value expected, remedy.
struct CalibrationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws CalibrationError if any part of the record is wrong; none of it is used then.
Calibration parse_calibration(std::span<const std::uint8_t> bytes);

/// Throws CalibrationError if parse_calibration would refuse the result.
std::array<std::uint8_t, calibration_bytes> bytes_of(const Calibration& calibration);

/// Converts counts, or differences of counts.
double insertion_mm(const TrackCalibration& track, double insertion_counts, double roll_counts);
double roll_deg(const TrackCalibration& track, double roll_counts);
double pressure_atm(const Calibration& calibration, std::int16_t counts);
double flow_mL_s(const Calibration& calibration, std::int16_t counts);

}  // namespace ostium::device
