#include "device/transport/usb_box.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "device/protocol/report.h"
#include "device/transport/usb_port.h"

namespace ostium::device {

namespace {

constexpr unsigned control_ms = 500;
constexpr std::uint8_t of_interface = +LIBUSB_REQUEST_TYPE_VENDOR | +LIBUSB_RECIPIENT_INTERFACE;
constexpr std::uint8_t from_box = of_interface | LIBUSB_ENDPOINT_IN, to_box = of_interface | LIBUSB_ENDPOINT_OUT;

bool is_interrupt(const libusb_endpoint_descriptor& e) {
  return (e.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) == LIBUSB_TRANSFER_TYPE_INTERRUPT;
}

std::optional<UsbInterface> interface_of(const libusb_interface_descriptor& d) {
  if (d.bInterfaceClass != usb_class || d.bInterfaceSubClass != usb_subclass || d.bInterfaceProtocol != usb_protocol)
    return {};
  UsbInterface found{d.bInterfaceNumber, 0, 0};
  for (int e = 0; e < d.bNumEndpoints; ++e) {
    if (!is_interrupt(d.endpoint[e])) continue;
    const std::uint8_t address = d.endpoint[e].bEndpointAddress;
    const bool in = (address & LIBUSB_ENDPOINT_DIR_MASK) == LIBUSB_ENDPOINT_IN;
    std::uint8_t& place = in ? found.in : found.out;
    if (!place) place = address;
  }
  if (!found.in || !found.out) return {};
  return found;
}

std::optional<UsbInterface> interface_of(libusb_device* device) {
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(device, &config) != 0 &&
      libusb_get_config_descriptor(device, 0, &config) != 0)
    return {};
  std::optional<UsbInterface> found;
  for (int i = 0; i < config->bNumInterfaces && !found; ++i)
    if (config->interface[i].num_altsetting > 0) found = interface_of(config->interface[i].altsetting[0]);
  libusb_free_config_descriptor(config);
  return found;
}

std::string text(libusb_device_handle* handle, std::uint8_t index) {
  std::array<unsigned char, 128> bytes;
  const int count = index ? libusb_get_string_descriptor_ascii(handle, index, bytes.data(), bytes.size()) : 0;
  return count > 0 ? std::string(bytes.begin(), bytes.begin() + count) : "";
}

}  // namespace

UsbContext::UsbContext() {
  if (const int error = libusb_init(&usb); error != 0)
    throw std::runtime_error(fmt::format("USB cannot be used: {}", libusb_strerror(static_cast<libusb_error>(error))));
}

void OpenUsbBox::close() {
  if (!handle) return;
  libusb_release_interface(handle, interface.number);
  libusb_close(handle);
  handle = nullptr;
}

PortTrouble OpenUsbBox::open(libusb_device* device, const std::string& serial) {
  identity = {"", "",
              fmt::format("bus {}, device {}", libusb_get_bus_number(device), libusb_get_device_address(device))};
  if (const int error = libusb_open(device, &handle); error != 0) {
    handle = nullptr;
    return error == LIBUSB_ERROR_ACCESS ? PortTrouble::no_access : PortTrouble::failing;
  }
  libusb_device_descriptor d{};
  libusb_get_device_descriptor(device, &d);
  identity.serial = text(handle, d.iSerialNumber), identity.product = text(handle, d.iProduct);
  const auto found = interface_of(device);
  PortTrouble trouble = found ? PortTrouble::none : PortTrouble::not_a_box;
  if (found) interface = *found;
  if (trouble == PortTrouble::none && (serial.empty() || serial == identity.serial))
    if (const int error = libusb_claim_interface(handle, interface.number); error != 0)
      trouble = error == LIBUSB_ERROR_BUSY ? PortTrouble::in_use : PortTrouble::failing;
  const bool another = !serial.empty() && serial != identity.serial;
  if (trouble == PortTrouble::none && !another) return trouble;
  libusb_close(handle);
  handle = nullptr;
  return trouble;
}

std::optional<std::size_t> OpenUsbBox::read(std::uint8_t request, std::span<std::uint8_t> into) const {
  const int count = libusb_control_transfer(handle, from_box, request, 0, static_cast<std::uint16_t>(interface.number),
                                            into.data(), static_cast<std::uint16_t>(into.size()), control_ms);
  if (count < 0) return {};
  return static_cast<std::size_t>(count);
}

bool OpenUsbBox::write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) const {
  const int count = libusb_control_transfer(
      handle, to_box, request, value, static_cast<std::uint16_t>(interface.number),
      const_cast<unsigned char*>(data.data()), static_cast<std::uint16_t>(data.size()), control_ms);
  return count >= 0 && static_cast<std::size_t>(count) == data.size();
}

void each_box(libusb_context* context, const std::function<bool(libusb_device*)>& visit) {
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context, &list);
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor d{};
    if (libusb_get_device_descriptor(list[i], &d) != 0 || d.idVendor != usb_vendor || d.idProduct != usb_product)
      continue;
    if (visit(list[i])) break;
  }
  if (count >= 0) libusb_free_device_list(list, 1);
}

}  // namespace ostium::device
