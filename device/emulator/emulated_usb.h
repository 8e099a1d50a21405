#pragma once
/// An emulated box as a USB host sees it: descriptors, control transfers, two interrupt endpoints. What carries it is
/// elsewhere (usbip.h, and the benches of tests/usb). Faults can be ordered, to test what a host makes of them.
#include <atomic>
#include <functional>
#include <mutex>

#include "device/emulator/emulated_box.h"

namespace ostium::device {

using ControlReply = std::optional<std::vector<std::uint8_t>>;  ///< nothing: stall

inline constexpr std::uint8_t emulated_in_endpoint = 0x81, emulated_out_endpoint = 0x02;

/// What goes wrong, until it is switched off again.
struct EmulatedFaults {
  bool silent = false;   ///< samples are made, none is sent
  bool stalled = false;  ///< the IN endpoint is halted; CLEAR_FEATURE ends it unless `stays_stalled`
  bool stays_stalled = false;
  bool garbled = false;        ///< transfers of the IN endpoint end with an error, as on a bad cable
  bool wrong_version = false;  ///< in reports and info
  std::function<void(std::vector<std::uint8_t>& report)> mangle;  ///< called with each report; may be empty
};

/// One mutex for all of it: a bench's thread, and the test that moves tools, use it.
class EmulatedUsb {
 public:
  explicit EmulatedUsb(const Calibration& calibration) : box_(calibration) {}

  /// Reads or changes box and faults.
  template <class Change>
  auto with(Change change) {
    const std::lock_guard guard(mutex_);
    return change(box_, faults_);
  }

  /// Called before each sample, to move tools by its clock; under the mutex.
  std::function<void(EmulatedBox&)> hand;

  /// A control transfer: 8 bytes of setup, and data if it goes to the box.
  ControlReply control(std::span<const std::uint8_t> setup, std::span<const std::uint8_t> data);

  struct Sample {
    bool stall = false, error = false;
    std::vector<std::uint8_t> bytes;  ///< empty and neither of these: nothing is sent
  };
  Sample sample();                                ///< the next of the IN endpoint
  void out(std::span<const std::uint8_t> bytes);  ///< on the OUT endpoint
  void detached();                                ///< unplugged, reset or suspended

 private:
  ControlReply standard(std::uint8_t request, std::uint16_t value, std::uint16_t index, std::uint16_t length);
  ControlReply descriptor(std::uint16_t value) const;

  std::mutex mutex_;
  EmulatedBox box_;
  EmulatedFaults faults_;
  std::uint8_t configuration_ = 0;
};

/// Raw descriptors, as sysfs has them: device, then configuration with interface and endpoints.
std::vector<std::uint8_t> device_descriptor();
std::vector<std::uint8_t> configuration_descriptor();

}  // namespace ostium::device
