#pragma once
/// An emulated box in this process, connected without a cable but with its protocol and timing. Each poll is one sample
/// of the box, whatever the clock says, so that results are reproducible.
#include <functional>

#include "device/emulator/emulated_box.h"
#include "device/transport/port.h"

namespace ostium::device {

class EmulatedPort : public Port {
 public:
  /// `box` and whatever `hand` refers to must outlive this. `hand` is called before each sample to move the box's
  /// surroundings. `delay`: samples until an OUT report arrives, 1 to longest_delay - 1.
  static constexpr int longest_delay = 64;
  EmulatedPort(EmulatedBox& box, std::function<void(EmulatedBox&)> hand, int delay = 1);

  bool plugged = true;  ///< may be unplugged and plugged in again

  PortState poll(double wait_s, ReportSink& sink) override;
  void send(std::span<const std::uint8_t> bytes) override;
  std::optional<std::size_t> read(std::uint8_t request, std::span<std::uint8_t> into) override;
  bool write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) override;
  const PortIdentity& identity() const override { return identity_; }
  const PortCounts& counts() const override { return counts_; }
  double now_s() const override { return box_.time_s(); }

 private:
  EmulatedBox& box_;
  std::function<void(EmulatedBox&)> hand_;
  int delay_;
  PortState state_;
  PortIdentity identity_;
  PortCounts counts_;
  /// OUT reports in flight: a ring, indexed by the sample before which each arrives.
  struct Underway {
    std::uint64_t at = 0;
    std::size_t count = 0;
    std::array<std::uint8_t, brake_report_bytes> bytes{};
  };
  std::array<Underway, longest_delay> underway_{};
  std::uint64_t samples_ = 0;
};

}  // namespace ostium::device
