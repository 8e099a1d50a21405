#include "device/emulator/usbip_protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "device/emulator/connection.h"
#include "device/transport/usb_port.h"

namespace ostium::device {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint16_t version = 0x0111;
constexpr std::uint16_t list_request = 0x8005, list_reply = 0x0005, attach_request = 0x8003, attach_reply = 0x0003;
constexpr std::size_t request_bytes = 8, bus_id_bytes = 32, header_bytes = 48;
constexpr std::uint32_t submit = 1, unlink = 2, submit_reply = 3, unlink_reply = 4;

std::uint16_t get_u16(std::span<const std::uint8_t> from, std::size_t at) {
  return static_cast<std::uint16_t>(from[at] << 8 | from[at + 1]);
}
std::uint32_t get_u32(std::span<const std::uint8_t> from, std::size_t at) {
  return std::uint32_t{get_u16(from, at)} << 16 | get_u16(from, at + 2);
}
void add_u16(Bytes& to, std::uint16_t value) {
  to.push_back(static_cast<std::uint8_t>(value >> 8)), to.push_back(static_cast<std::uint8_t>(value));
}
void add_u32(Bytes& to, std::uint32_t value) {
  add_u16(to, static_cast<std::uint16_t>(value >> 16)), add_u16(to, static_cast<std::uint16_t>(value));
}
void add_text(Bytes& to, std::string_view text, std::size_t length) {
  to.insert(to.end(), text.begin(), text.end());
  to.resize(to.size() + length - text.size(), 0);
}

Bytes answer(std::uint16_t code, UsbipStatus status) {
  Bytes b;
  add_u16(b, version), add_u16(b, code), add_u32(b, static_cast<std::uint32_t>(status));
  return b;
}

void add_device(Bytes& to) {
  add_text(to, "/sys/devices/ostium/usb1/1-1", 256), add_text(to, usbip_bus_id, bus_id_bytes);
  add_u32(to, usbip_device >> 16), add_u32(to, usbip_device & 0xffff), add_u32(to, usbip_speed);
  add_u16(to, usb_vendor), add_u16(to, usb_product), add_u16(to, 0x0100);
  for (const int b : {0, 0, 0, 1, 1, 1}) to.push_back(static_cast<std::uint8_t>(b));
}

Bytes reply_header(std::uint32_t command, std::uint32_t number, std::int32_t status, std::uint32_t length) {
  Bytes h;
  add_u32(h, command), add_u32(h, number);
  h.resize(20, 0);  // device, direction and endpoint, which replies leave out
  add_u32(h, static_cast<std::uint32_t>(status)), add_u32(h, length);
  h.resize(header_bytes, 0);
  return h;
}

}  // namespace

std::optional<UsbipRequest> parse_usbip_request(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < request_bytes) return {};
  const std::uint16_t theirs = get_u16(bytes, 0), code = get_u16(bytes, 2);
  if (theirs != version)
    throw ConnectionEnd(fmt::format("the host speaks version {:#06x} of USB/IP, not {:#06x}", theirs, version));
  if (code == list_request) return UsbipRequest{false, "", request_bytes};
  if (code != attach_request) throw ConnectionEnd(fmt::format("the host sent the unknown request {:#06x}", code));
  if (bytes.size() < request_bytes + bus_id_bytes) return {};
  const auto id = bytes.subspan(request_bytes, bus_id_bytes);
  return UsbipRequest{true, {id.begin(), std::find(id.begin(), id.end(), 0)}, request_bytes + bus_id_bytes};
}

std::vector<std::uint8_t> usbip_list_answer() {
  Bytes b = answer(list_reply, UsbipStatus::ok);
  add_u32(b, 1);  // device
  add_device(b);
  for (const int i : {int{usb_class}, int{usb_subclass}, int{usb_protocol}, 0})
    b.push_back(static_cast<std::uint8_t>(i));
  return b;
}

std::vector<std::uint8_t> usbip_attach_answer(UsbipStatus status) {
  Bytes b = answer(attach_reply, status);
  if (status == UsbipStatus::ok) add_device(b);
  return b;
}

std::optional<UsbipCommand> parse_usbip_command(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < header_bytes) return {};
  const std::uint32_t kind = get_u32(bytes, 0), direction = get_u32(bytes, 12);
  if (kind != submit && kind != unlink)
    throw ConnectionEnd(fmt::format("the host sent the unknown command {:#010x}", kind));
  UsbipCommand c;
  c.number = get_u32(bytes, 4), c.unlinks = kind == unlink, c.bytes = header_bytes;
  if (c.unlinks) {
    c.unlinked = get_u32(bytes, 20);
    return c;
  }
  if (direction > 1) throw ConnectionEnd(fmt::format("the host sent a transfer of direction {}", direction));
  c.in = direction == 1, c.endpoint = get_u32(bytes, 16), c.length = get_u32(bytes, 24);
  if (c.length > (c.in ? usbip_longest_in : usbip_longest_out))
    throw ConnectionEnd(fmt::format("the host sent a transfer {} of {} bytes", c.in ? "in" : "out", c.length));
  c.setup = bytes.subspan(40, 8);
  if (c.in) return c;
  if (bytes.size() < header_bytes + c.length) return {};
  c.data = bytes.subspan(header_bytes, c.length), c.bytes += c.length;
  return c;
}

std::vector<std::uint8_t> usbip_submit_reply(std::uint32_t number, std::int32_t status, std::uint32_t length,
                                             std::span<const std::uint8_t> data) {
  Bytes b = reply_header(submit_reply, number, status, length);
  b.insert(b.end(), data.begin(), data.end());
  return b;
}

std::vector<std::uint8_t> usbip_unlink_reply(std::uint32_t number, std::int32_t status) {
  return reply_header(unlink_reply, number, status, 0);
}

}  // namespace ostium::device
