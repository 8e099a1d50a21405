#pragma once
/// libusb's side of a tracking box: the session, finding boxes on the bus, opening one, its control requests.
#include <libusb.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "device/transport/port.h"

namespace ostium::device {

struct UsbInterface {
  int number = 0;
  std::uint8_t in = 0, out = 0;  ///< endpoints
};

struct UsbContext {
  libusb_context* usb = nullptr;
  UsbContext();  ///< throws runtime_error
  UsbContext(const UsbContext&) = delete;
  UsbContext& operator=(const UsbContext&) = delete;
  ~UsbContext() { libusb_exit(usb); }
};

/// A box that is open and ours, for as long as this lives.
struct OpenUsbBox {
  libusb_device_handle* handle = nullptr;
  UsbInterface interface;
  PortIdentity identity;

  OpenUsbBox() = default;
  OpenUsbBox(const OpenUsbBox&) = delete;
  OpenUsbBox& operator=(const OpenUsbBox&) = delete;
  ~OpenUsbBox() { close(); }

  void close();
  /// `serial`: only the box of this one; empty: any.
  PortTrouble open(libusb_device* device, const std::string& serial);
  std::optional<std::size_t> read(std::uint8_t request, std::span<std::uint8_t> into) const;
  bool write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) const;
};

/// Calls `visit` for each box on the bus until it returns true.
void each_box(libusb_context* context, const std::function<bool(libusb_device*)>& visit);

}  // namespace ostium::device
