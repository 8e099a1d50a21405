#pragma once
/// Messages of the USB/IP protocol of the Linux kernel (Documentation/usb/usbip_protocol.rst), version 1.1.1: bytes to
/// values and back. Integers are big endian.
///
/// The parsers return nullopt while a message is not complete, and throw ConnectionEnd with what came if it is none.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ostium::device {

inline constexpr std::uint16_t usbip_port = 3240;
inline constexpr const char* usbip_bus_id = "1-1";
inline constexpr std::uint32_t usbip_device = 0x10002;         ///< bus 1, device 2
inline constexpr int usbip_speed = 2;                          ///< full speed, 12 Mbit/s, in the kernel's numbering
inline constexpr std::uint32_t usbip_longest_out = 4096;       ///< bytes; the box takes none longer
inline constexpr std::uint32_t usbip_longest_in = 16'777'216;  ///< bytes; all that the kernel's usbfs grants

/// What a host asks first.
struct UsbipRequest {
  bool attaches = false;  ///< else lists devices
  std::string bus_id;
  std::size_t bytes = 0;  ///< length of the message
};
std::optional<UsbipRequest> parse_usbip_request(std::span<const std::uint8_t> bytes);

/// Status of an answer, in the kernel's numbering.
enum class UsbipStatus : std::uint32_t { ok = 0, in_use = 2, no_such_device = 4 };
std::vector<std::uint8_t> usbip_list_answer();
std::vector<std::uint8_t> usbip_attach_answer(UsbipStatus status);

/// A command of a host that has attached the box.
struct UsbipCommand {
  std::uint32_t number = 0;
  bool unlinks = false;        ///< takes back the transfer `unlinked`; else submits one, and the rest applies
  std::uint32_t unlinked = 0;  ///< its number
  bool in = false;             ///< from the box to the host
  std::uint32_t endpoint = 0, length = 0;
  std::span<const std::uint8_t> setup, data;  ///< in the bytes that were parsed
  std::size_t bytes = 0;                      ///< length of the message
};
std::optional<UsbipCommand> parse_usbip_command(std::span<const std::uint8_t> bytes);

/// Statuses are negative error numbers of Linux, or 0. `length`: bytes transferred.
std::vector<std::uint8_t> usbip_submit_reply(std::uint32_t number, std::int32_t status, std::uint32_t length,
                                             std::span<const std::uint8_t> data);
std::vector<std::uint8_t> usbip_unlink_reply(std::uint32_t number, std::int32_t status);

}  // namespace ostium::device
