#pragma once
/// An emulated box on a socket, with the USB/IP protocol of the Linux kernel (Documentation/usb/usbip_protocol.rst),
/// version 1.1.1: any Linux machine can attach it as a real device (`usbip attach -r HOST -b 1-1`; module vhci_hcd).
#include <atomic>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "device/emulator/emulated_usb.h"

namespace ostium::device {

inline constexpr std::uint16_t usbip_port = 3240;
inline constexpr std::uint32_t usbip_device = 0x10002;  ///< bus 1, device 2
inline constexpr int usbip_speed = 2;                   ///< full speed, 12 Mbit/s, in the kernel's numbering

/// An attached host at the other end of a connected socket.
class UsbipLink {
 public:
  /// Takes ownership of `socket`.
  UsbipLink(EmulatedUsb& usb, int socket) : usb_(usb), socket_(socket) {}
  ~UsbipLink();
  UsbipLink(const UsbipLink&) = delete;
  UsbipLink& operator=(const UsbipLink&) = delete;

  /// Serves the host with a sample every millisecond until it leaves or `over` becomes true. `fast`: a sample whenever
  /// the host waits for one.
  void serve(const std::atomic<bool>& over, const std::atomic<bool>* fast = nullptr);

  /// Samples delayed because the host had no transfer in flight.
  long late() const { return late_; }

 private:
  struct Waiting {
    std::uint32_t number, length;
  };
  bool receive();
  bool take_command(const std::uint8_t* header, const std::vector<std::uint8_t>& data);
  bool reply(std::uint32_t number, std::int32_t status, std::uint32_t length, const std::vector<std::uint8_t>& data);
  bool tick(bool even_if_lost);
  bool send_all(const std::vector<std::uint8_t>& bytes);

  EmulatedUsb& usb_;
  int socket_;
  std::deque<Waiting> in_;
  std::vector<std::uint8_t> received_;
  bool sampled_ = false;
  std::atomic<long> late_ = 0;
};

/// Listens for hosts until `over`; one at a time can attach the box. Throws std::runtime_error if the port is not
/// available. `any_host`: accepts other machines as well as this one.
void serve_usbip(EmulatedUsb& usb, std::uint16_t port, bool any_host, const std::atomic<bool>& over,
                 const std::function<void(const std::string&)>& say);

}  // namespace ostium::device
