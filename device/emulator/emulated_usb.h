#pragma once
/// An emulated box as a USB host sees it: descriptors, control transfers, two interrupt endpoints. The transport is
/// elsewhere (usbip.h, and the benches of tests/integration/usb). Faults can be injected to test the host.
#include <atomic>
#include <functional>
#include <mutex>

#include "device/emulator/emulated_box.h"

namespace ostium::device {

using ControlReply = std::optional<std::vector<std::uint8_t>>;  ///< nullopt: stall

inline constexpr std::uint8_t emulated_in_endpoint = 0x81, emulated_out_endpoint = 0x02;

/// Injected faults; each lasts until it is switched off.
struct EmulatedFaults {
  bool silent = false;   ///< samples are made, but none is sent
  bool stalled = false;  ///< the IN endpoint is halted; CLEAR_FEATURE clears it unless `stays_stalled`
  bool stays_stalled = false;
  bool garbled = false;        ///< transfers of the IN endpoint end with an error, as with a bad cable
  bool wrong_version = false;  ///< in reports and info
  std::function<void(std::vector<std::uint8_t>& report)> mangle;  ///< called with each report; may be empty
};

/// One mutex guards everything: a bench's thread and the test that moves the tools both use it.
class EmulatedUsb {
 public:
  explicit EmulatedUsb(const Calibration& calibration) : box_(calibration) {}

  /// Reads or changes box and faults under the mutex.
  template <class Change>
  auto with(Change change) {
    const std::lock_guard guard(mutex_);
    return change(box_, faults_);
  }

  /// What is called before each sample, under the mutex, to move tools by the box's clock; may be empty.
  void set_hand(std::function<void(EmulatedBox&)> hand) {
    const std::lock_guard guard(mutex_);
    hand_ = std::move(hand);
  }

  /// A control transfer: 8 bytes of setup, and data if its direction is to the box.
  ControlReply control(std::span<const std::uint8_t> setup, std::span<const std::uint8_t> data);

  struct Sample {
    bool stall = false, error = false;
    std::vector<std::uint8_t> bytes;  ///< empty, and neither flag set: nothing is sent
  };
  Sample sample();                                ///< the next sample of the IN endpoint
  void out(std::span<const std::uint8_t> bytes);  ///< on the OUT endpoint
  void detached();                                ///< unplugged, reset or suspended

 private:
  ControlReply standard(std::uint8_t request, std::uint16_t value, std::uint16_t index, std::uint16_t length);
  ControlReply descriptor(std::uint16_t value) const;

  std::mutex mutex_;
  std::function<void(EmulatedBox&)> hand_;
  EmulatedBox box_;
  EmulatedFaults faults_;
  std::uint8_t configuration_ = 0;
};

/// Raw descriptors, as in sysfs: device, then configuration with interface and endpoints.
std::vector<std::uint8_t> device_descriptor();
std::vector<std::uint8_t> configuration_descriptor();

}  // namespace ostium::device
