#pragma once
/// A host that has attached the emulated box, at the other end of a connected socket.
#include <atomic>
#include <deque>

#include "device/emulator/connection.h"
#include "device/emulator/emulated_usb.h"
#include "device/emulator/usbip_protocol.h"

namespace ostium::device {

class UsbipLink {
 public:
  static constexpr std::size_t most_waiting = 64;  ///< IN transfers; a driver has eight, so such a host is broken

  UsbipLink(EmulatedUsb& usb, Connection host) : usb_(usb), host_(std::move(host)) {}
  ~UsbipLink() { usb_.detached(); }
  UsbipLink(const UsbipLink&) = delete;
  UsbipLink& operator=(const UsbipLink&) = delete;

  /// Serves the host with a sample every millisecond until `over` becomes true; returns why it ended. `fast`: a sample
  /// whenever the host waits for one.
  std::string serve(const std::atomic<bool>& over, const std::atomic<bool>* fast = nullptr);

  // The same for a loop that waits for others as well: wait_for awaited() until due(), then go on, again and again.
  pollfd awaited() const { return host_.awaited(); }
  Connection::Clock::time_point due(bool fast = false) const;
  void go_on(bool fast = false);  ///< throws ConnectionEnd

  /// Samples delayed because the host had no transfer in flight, or did not read.
  long late() const { return late_; }

 private:
  struct Waiting {
    std::uint32_t number, length;
  };
  void take(const UsbipCommand& command);
  void take_back(const UsbipCommand& command);
  void sample();
  void reply(std::uint32_t number, std::int32_t status, std::uint32_t length, std::span<const std::uint8_t> data = {});
  bool can_sample() const { return !waiting_.empty() && !host_.clogged(); }

  EmulatedUsb& usb_;
  Connection host_;
  std::deque<Waiting> waiting_;
  Connection::Clock::time_point due_ = Connection::Clock::now();
  int put_off_ = 0;
  std::atomic<long> late_ = 0;
};

}  // namespace ostium::device
