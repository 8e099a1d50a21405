#pragma once
/// What is between the host and a tracking box: a USB cable (usb_port.h), or nothing at all (emulated_port.h). It
/// carries bytes and knows nothing of what they mean.
///
/// One thread uses a port. It calls `poll` again and again, and everything happens in there.
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace ostium::device {

/// Why there is no box, or a box that gives nothing.
enum class PortTrouble : std::uint8_t {
  none,
  no_access,  ///< it is there, and may not be opened: on Linux the udev rule is missing
  in_use,     ///< another program has it
  not_a_box,  ///< it does not have the protocol's interface and endpoints
  stalled,    ///< its endpoint refuses, again and again
  failing,    ///< transfers end with errors
};

struct PortState {
  bool open = false;
  std::uint32_t openings = 0;  ///< how often a box was opened: it grows when one is plugged in again
  PortTrouble trouble = PortTrouble::none;
};

/// What a port has seen; only ever grows.
struct PortCounts {
  std::uint64_t in = 0;        ///< IN transfers that brought something
  std::uint64_t out = 0;       ///< OUT transfers that arrived
  std::uint64_t replaced = 0;  ///< OUT reports that a newer one replaced while they waited
  std::uint64_t stalls = 0, errors = 0, departures = 0;
};

struct PortIdentity {
  std::string serial, product;
  std::string place;  ///< "bus 1, device 2"
};

class ReportSink {
 public:
  virtual ~ReportSink() = default;
  /// An IN report's bytes, in the order in which they came. Must not call the port.
  virtual void came(std::span<const std::uint8_t> bytes) = 0;
};

class Port {
 public:
  virtual ~Port() = default;

  /// Waits until something came, at most `wait_s`; gives all that came to `sink`. Looks for a box if none is open.
  virtual PortState poll(double wait_s, ReportSink& sink) = 0;

  /// Starts an OUT report. At most one is on its way; one that waits is replaced. Never blocks; dropped if not open.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;

  /// Vendor requests of the interface; block up to half a second, and give what comes meanwhile to the last `sink`.
  /// How many bytes came, into `into`; nothing: the box refused (stall), or there is none.
  virtual std::optional<std::size_t> read(std::uint8_t request, std::span<std::uint8_t> into) = 0;
  virtual bool write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data = {}) = 0;

  virtual const PortIdentity& identity() const = 0;  ///< of the box that is open, or was last
  virtual const PortCounts& counts() const = 0;
  virtual double now_s() const = 0;  ///< the clock by which a box is silent or late
};

}  // namespace ostium::device
