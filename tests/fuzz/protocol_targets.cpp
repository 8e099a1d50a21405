#include <algorithm>
#include <cstdint>
#include <span>

#include "device/emulator/connection.h"
#include "device/emulator/emulated_usb.h"
#include "device/emulator/usbip_protocol.h"
#include "device/protocol/calibration.h"
#include "device/protocol/report.h"
#include "device/transport/control.h"
#include "tests/fuzz/target.h"

namespace ostium::fuzz {

namespace {

using Packet = std::span<const std::uint8_t>;

Packet packet_of(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}
std::string text_of(Packet bytes) { return {bytes.begin(), bytes.end()}; }

device::Calibration calibration() {
  device::Calibration c;
  c.serial = "fuzz";
  return c;
}

std::vector<Seed> reports() {
  device::InReport in;
  in.sequence = 77, in.insertion = {1, -2, 3, 4}, in.tool[1] = device::Tool::wire, in.pedals = 3;
  device::OutReport out;
  out.sequence = 5, out.clamp = {0, 100, 65535, 1}, out.arm = true;
  device::OutReport apart = out;
  apart.rotary = {1, 2, 3, 65535};
  return {{"in", text_of(bytes_of(in))}, {"out", text_of(bytes_of(out))}, {"brakes", text_of(brake_bytes_of(apart))}};
}

/// What is taken is what its bytes say: written again it gives the same bytes.
Answer read_report(const Seed& input) {
  const Packet bytes = packet_of(input.bytes);
  const auto same = [&](const auto& written) {
    require(std::ranges::equal(written, bytes), "a report that is taken gives its bytes again");
  };
  const auto in = device::parse_in_report(bytes);
  const auto out = device::parse_out_report(bytes);
  require(in.has_value() == (device::flaw_of_in_report(bytes) == device::Flaw::none),
          "a report without a flaw is taken");
  if (in) same(bytes_of(*in));
  if (out && out->rotary) same(brake_bytes_of(*out));
  if (out && !out->rotary) same(bytes_of(*out));
  device::parse_info(bytes), device::parse_statistics(bytes);
  return in || out ? Answer::taken : Answer::refused;
}

std::vector<Seed> records() { return {{"calibration", text_of(bytes_of(calibration()))}}; }

Answer read_record(const Seed& input) {
  const Packet bytes = packet_of(input.bytes);
  return answer_of<device::CalibrationError>([&] {
    require(std::ranges::equal(bytes_of(device::parse_calibration(bytes)), bytes), "a record gives its bytes again");
  });
}

void add_u32(std::string& to, std::uint32_t value) {
  for (int k = 3; k >= 0; --k) to += static_cast<char>(value >> 8 * k & 0xff);
}

std::string usbip_command(std::uint32_t kind, std::uint32_t direction, std::uint32_t endpoint,
                          const std::string& data) {
  std::string message;
  for (const std::uint32_t word : {kind, 9u, device::usbip_device, direction, endpoint, 0u,
                                   static_cast<std::uint32_t>(direction ? 64 : data.size()), 0u, 0xffffffffu, 0u})
    add_u32(message, word);
  return message + std::string("\x80\x06\x00\x01\x00\x00\x12\x00", 8) + data;
}

std::vector<Seed> usbip_messages() {
  std::string list, attach;
  add_u32(list, 0x01118005), add_u32(list, 0);
  add_u32(attach, 0x01118003), add_u32(attach, 0);
  attach += device::usbip_bus_id;
  attach.resize(40, '\0');
  return {{"list", list},
          {"attach", attach},
          {"in", usbip_command(1, 1, 1, "")},
          {"control", usbip_command(1, 1, 0, "")},
          {"out", usbip_command(1, 0, 2, text_of(bytes_of(device::OutReport{})))},
          {"unlink", usbip_command(2, 0, 0, "")}};
}

/// A message is no longer than what came, and its parts lie in it.
Answer read_usbip(const Seed& input) {
  const Packet bytes = packet_of(input.bytes);
  bool taken = false;
  const auto within = [&](Packet part) {
    return part.empty() || (part.data() >= bytes.data() && part.data() + part.size() <= bytes.data() + bytes.size());
  };
  const auto ask = [&](auto&& parse) { return answer_of<device::ConnectionEnd>(parse); };
  ask([&] {
    if (const auto request = device::parse_usbip_request(bytes)) {
      require(request->bytes <= bytes.size(), "a request is no longer than what came");
      taken = true;
    }
  });
  ask([&] {
    if (const auto command = device::parse_usbip_command(bytes)) {
      require(command->bytes <= bytes.size() && within(command->setup) && within(command->data),
              "a command lies in what came");
      taken = true;
    }
  });
  return taken ? Answer::taken : Answer::refused;
}

/// One after another: descriptors, configuration, info, calibration in and out.
std::vector<Seed> transfers() {
  std::string all;
  for (const char* setup :
       {"\x80\x06\x00\x01\x00\x00\x12\x00", "\x80\x06\x00\x02\x00\x00\xff\x00", "\x00\x09\x01\x00\x00\x00\x00\x00",
        "\x01\x0b\x00\x00\x00\x00\x00\x00", "\xc1\x01\x00\x00\x00\x00\x08\x00", "\xc1\x02\x00\x00\x00\x00\x40\x00",
        "\x41\x03\x00\x00\x00\x00\x40\x00", "\x41\x04\x43\x54\x00\x00\x00\x00"})
    all += std::string(setup, 8) + text_of(bytes_of(device::OutReport{}));
  return {{"transfers", all}};
}

/// The emulated box as a host sees it: control transfers and OUT reports, after which it still makes samples.
Answer read_transfer(const Seed& input) {
  device::EmulatedUsb usb(calibration());
  const Packet bytes = packet_of(input.bytes);
  if (bytes.size() < 8) return Answer::refused;
  bool taken = false;
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 24) {
    const Packet data = bytes.subspan(at + 8, std::min<std::size_t>(16, bytes.size() - at - 8));
    taken = usb.control(bytes.subspan(at, 8), data).has_value() || taken;
    usb.out(data);
  }
  const device::EmulatedUsb::Sample sample = usb.sample();
  require(sample.bytes.empty() || device::parse_in_report(sample.bytes).has_value(), "the box sends whole reports");
  return taken ? Answer::taken : Answer::refused;
}

}  // namespace

std::vector<Target> protocol_targets() {
  return {{"report", reports, read_report},
          {"calibration", records, read_record},
          {"usbip", usbip_messages, read_usbip},
          {"transfer", transfers, read_transfer}};
}

}  // namespace ostium::fuzz
