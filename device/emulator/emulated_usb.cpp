#include "device/emulator/emulated_usb.h"

#include <algorithm>
#include <string_view>

#include "device/protocol/bytes.h"
#include "device/transport/usb_port.h"

namespace ostium::device {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t microsoft_request = 0x20;  // any vendor request that the interface does not use
constexpr std::uint16_t microsoft_set_length = 162;

void append_u16(Bytes& to, std::uint16_t value) { to.push_back(value & 0xff), to.push_back(value >> 8); }

void append_utf16(Bytes& to, std::string_view text) {
  for (const char c : text) append_u16(to, static_cast<std::uint8_t>(c));
}

Bytes string_descriptor(std::string_view text) {
  Bytes d{static_cast<std::uint8_t>(2 + 2 * text.size()), 3};
  append_utf16(d, text);
  return d;
}

/// Binary object store: one platform capability, which tells Windows how to get the descriptor set below.
Bytes bos_descriptor() {
  Bytes d{5, 15, 33, 0, 1, 28, 16, 5, 0};
  for (const int b : {0xDF, 0x60, 0xDD, 0xD8, 0x89, 0x45, 0xC7, 0x4C, 0x9C, 0xD2, 0x65, 0x9D, 0x9E, 0x64, 0x8A, 0x9F})
    d.push_back(static_cast<std::uint8_t>(b));
  for (const int b : {0x00, 0x00, 0x03, 0x06}) d.push_back(static_cast<std::uint8_t>(b));  // Windows 8.1 and later
  append_u16(d, microsoft_set_length);
  d.push_back(microsoft_request), d.push_back(0);
  return d;
}

/// Microsoft OS 2.0 descriptor set: selects WinUSB as the driver, and an interface GUID by which programs find the box.
Bytes microsoft_set() {
  Bytes d;
  append_u16(d, 10), append_u16(d, 0), append_u16(d, 0), append_u16(d, 0x0603), append_u16(d, microsoft_set_length);
  append_u16(d, 20), append_u16(d, 3);
  for (const char c : std::string_view("WINUSB\0\0\0\0\0\0\0\0\0\0", 16)) d.push_back(static_cast<std::uint8_t>(c));
  append_u16(d, 132), append_u16(d, 4), append_u16(d, 7);
  append_u16(d, 42), append_utf16(d, std::string_view("DeviceInterfaceGUIDs\0", 21));
  append_u16(d, 80), append_utf16(d, std::string_view("{6B0C9C1E-52F0-4B8E-9A3D-3F5E0B5C7D21}\0\0", 40));
  return d;
}

bool reads(std::uint8_t request) {
  const auto r = static_cast<Request>(request);
  return r == Request::info || r == Request::read_calibration || r == Request::statistics;
}

}  // namespace

std::vector<std::uint8_t> device_descriptor() {
  Bytes d{18, 1, 0x10, 0x02, 0, 0, 0, 64, 0, 0, 0, 0, 0, 1, 1, 2, 3, 1};  // last: strings of maker, product, serial
  put(d, 8, usb_vendor), put(d, 10, usb_product);
  return d;
}

std::vector<std::uint8_t> configuration_descriptor() {
  return {9,
          2,
          32,
          0,
          1,
          1,
          0,
          0x80,
          250,  // powered by the bus, 500 mA
          9,
          4,
          0,
          0,
          2,
          usb_class,
          usb_subclass,
          usb_protocol,
          0,  //
          7,
          5,
          emulated_in_endpoint,
          3,
          64,
          0,
          1,  //
          7,
          5,
          emulated_out_endpoint,
          3,
          64,
          0,
          1};
}

ControlReply EmulatedUsb::descriptor(std::uint16_t value) const {
  switch (value >> 8) {
    case 1:
      return device_descriptor();
    case 2:
      return configuration_descriptor();
    case 3:
      switch (value & 0xff) {
        case 0:
          return Bytes{4, 3, 0x09, 0x04};
        case 1:
          return string_descriptor("Ostium");
        case 2:
          return string_descriptor("Tracking box (emulated)");
        case 3:
          return string_descriptor(box_.calibration().serial);
      }
      return {};
    case 15:
      return bos_descriptor();
  }
  return {};
}

ControlReply EmulatedUsb::standard(std::uint8_t request, std::uint16_t value, std::uint16_t index, std::uint16_t) {
  switch (request) {
    case 0: {  // GET_STATUS
      const bool halted = (index & 0xff) == emulated_in_endpoint && faults_.stalled;
      return Bytes{static_cast<std::uint8_t>(halted), 0};
    }
    case 1:  // CLEAR_FEATURE
      if (value == 0 && (index & 0xff) == emulated_in_endpoint && !faults_.stays_stalled) faults_.stalled = false;
      return Bytes{};
    case 6:
      return descriptor(value);
    case 8:
      return Bytes{configuration_};
    case 9:
      configuration_ = static_cast<std::uint8_t>(value);
      box_.release();
      return Bytes{};
    case 10:
      return Bytes{0};
    case 3:   // SET_FEATURE
    case 11:  // SET_INTERFACE
      return Bytes{};
  }
  return {};
}

ControlReply EmulatedUsb::control(std::span<const std::uint8_t> setup, std::span<const std::uint8_t> data) {
  if (setup.size() != 8) return {};
  const std::lock_guard guard(mutex_);
  const std::uint8_t type = setup[0], request = setup[1];
  const auto value = get<std::uint16_t>(setup, 2), index = get<std::uint16_t>(setup, 4),
             length = get<std::uint16_t>(setup, 6);
  ControlReply reply;
  if ((type & 0x60) == 0) {
    reply = standard(request, value, index, length);
  } else if (type == 0xc0) {
    if (request == microsoft_request && index == 7) reply = microsoft_set();
  } else if ((type & 0x7f) == 0x41) {
    if (reads(request) == ((type & 0x80) != 0)) reply = box_.control(request, value, data);
    if (reply && request == static_cast<std::uint8_t>(Request::info) && faults_.wrong_version) ++(*reply)[0];
  }
  if (reply && reply->size() > length) reply->resize(length);
  return reply;
}

EmulatedUsb::Sample EmulatedUsb::sample() {
  const std::lock_guard guard(mutex_);
  if (hand_) hand_(box_);
  const auto report = box_.sample();
  if (faults_.stalled) return {true, false, {}};
  if (faults_.garbled) return {false, true, {}};
  if (faults_.silent) return {};
  Sample sample{false, false, {report.begin(), report.end()}};
  if (faults_.wrong_version) ++sample.bytes[1];
  if (faults_.mangle) faults_.mangle(sample.bytes);
  return sample;
}

void EmulatedUsb::out(std::span<const std::uint8_t> bytes) {
  const std::lock_guard guard(mutex_);
  box_.take(bytes);
}

void EmulatedUsb::detached() {
  const std::lock_guard guard(mutex_);
  box_.release();
}

}  // namespace ostium::device
