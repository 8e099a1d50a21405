#pragma once
/// A software tracking box: its firmware's behaviour as a state machine in device time. Its only interface is the bytes
/// of the protocol, so a driver, a test or a socket can be connected to it. It can serve as a model for firmware.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "device/protocol/calibration.h"
#include "device/protocol/report.h"
#include "device/transport/control.h"

namespace ostium::device {

/// Of the boxes that `ostium` emulates.
inline constexpr const char* emulated_serial = "EMULATED";

/// What a sensor station of the box sees.
struct EmulatedTool {
  Tool tool = Tool::none;
  std::uint8_t quality = 0;
  double advanced_mm = 0, turned_deg = 0;  ///< since the box was built
};

class EmulatedBox {
 public:
  explicit EmulatedBox(const Calibration& calibration) : calibration_(calibration) {}

  // The box's surroundings; may be changed at will between two samples.
  std::array<EmulatedTool, 4> station;
  double pressure_atm = 0, flow_mL_s = 0;
  std::uint16_t pedals = 0;
  bool emergency_stop = false, over_temperature = false;
  bool separate_brakes = false;  ///< what it is built with; without them it knows no reports for them

  /// The next sample: advances time by 1 / rate.
  std::array<std::uint8_t, in_report_bytes> sample();

  /// Takes an OUT report. One that breaks a rule is ignored as a whole and counted.
  void take(std::span<const std::uint8_t> bytes);

  /// The answer to a control request, empty for one without data; nullopt: stall, and nothing was changed.
  std::optional<std::vector<std::uint8_t>> control(std::uint8_t request, std::uint16_t value,
                                                   std::span<const std::uint8_t> data = {});

  /// Suspended, reset or unplugged: the clamps open. Counts, time and calibration are kept.
  void release();

  /// Levels of the clamps, or of the brakes for pushing; 0 unless armed.
  const std::array<std::uint16_t, 4>& clamp() const { return clamp_; }
  /// Of the brakes for turning: the same as `clamp` where one clamp does both.
  const std::array<std::uint16_t, 4>& rotary() const { return rotary_; }
  const Calibration& calibration() const { return calibration_; }
  double time_s() const { return 1e-6 * static_cast<double>(time_us_); }

 private:
  InReport report() const;
  std::array<std::int32_t, 2> counts(std::size_t k) const;

  Calibration calibration_;
  std::vector<std::uint8_t> written_calibration_;
  std::array<std::array<std::int32_t, 2>, 4> zero_{};
  std::array<std::uint16_t, 4> clamp_{}, rotary_{};
  bool armed_ = false, watchdog_released_ = false;
  bool arm_was_low_ = false;  ///< an OUT report without ARM has come since the clamps opened
  std::uint64_t time_us_ = 0, last_out_us_ = 0;
  bool any_out_ = false;
  std::uint16_t rate_Hz_ = 1000, watchdog_ms_ = 50, last_out_sequence_ = 0;
  std::uint32_t sequence_ = 0, taken_ = 0, ignored_ = 0, releases_ = 0;
};

}  // namespace ostium::device
