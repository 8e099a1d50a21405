#pragma once
/// Reads a box's counts while the user makes a known movement.
#include <array>
#include <string>

#include "device/host/tracking_box.h"
#include "device/transport/usb_port.h"

namespace ostium::app {

/// The box's raw counts since `begin`. Throws LoadError if there is no box or it is unplugged.
class Measurement : private device::ReportSink {
 public:
  explicit Measurement(const std::string& serial);

  device::UsbPort& port() { return port_; }

  /// Waits for Enter, or for that many seconds. Throws LoadError if the input ends, or the box is unplugged.
  void wait(const std::string& what, double seconds);

  void begin() {
    insertion_ = roll_ = {};
    pressure_ = flow_ = elapsed_s_ = 0;
    samples_ = 0;
  }

  std::int64_t insertion(std::size_t track) const { return insertion_[track]; }
  std::int64_t roll(std::size_t track) const { return roll_[track]; }
  /// These throw LoadError if nothing came since.
  double mean_pressure() const { return mean(pressure_); }
  double mean_flow() const { return mean(flow_); }
  double elapsed_s() const { return elapsed_s_; }

 private:
  void came(std::span<const std::uint8_t> bytes) override;
  double mean(double sum) const;

  device::UsbPort port_;
  device::PortState state_;
  device::InReport last_;
  std::uint64_t reports_ = 0;
  std::array<std::int64_t, 4> insertion_{}, roll_{};
  double pressure_ = 0, flow_ = 0, elapsed_s_ = 0, samples_ = 0;
};

}  // namespace ostium::app
