#pragma once
/// The connection between host and tracking box: a USB cable (usb_port.h), or an emulated box (emulated_port.h). It
/// carries bytes and does not interpret them.
///
/// Used by one thread, which calls `poll` repeatedly; all work is done there.
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace ostium::device {

/// Why there is no box, or no data from it.
enum class PortTrouble : std::uint8_t {
  none,
  no_access,  ///< it is there, but may not be opened: on Linux the udev rule is missing
  in_use,     ///< another program uses it
  not_a_box,  ///< it lacks the protocol's interface and endpoints
  stalled,    ///< its endpoint stalls repeatedly
  failing,    ///< transfers end with errors
};

struct PortState {
  bool open = false;
  std::uint32_t openings = 0;  ///< how often a box was opened; increases when one is plugged in again
  PortTrouble trouble = PortTrouble::none;
};

/// Statistics of a port; they only increase.
struct PortCounts {
  std::uint64_t in = 0;        ///< IN transfers with data
  std::uint64_t out = 0;       ///< OUT transfers delivered
  std::uint64_t replaced = 0;  ///< pending OUT reports replaced by a newer one
  std::uint64_t stalls = 0, errors = 0, departures = 0;
};

struct PortIdentity {
  std::string serial, product;
  std::string place;  ///< "bus 1, device 2"
};

class ReportSink {
 public:
  virtual ~ReportSink() = default;
  /// Receives an IN report's bytes, in order. Must not call the port.
  virtual void came(std::span<const std::uint8_t> bytes) = 0;
};

class Port {
 public:
  virtual ~Port() = default;

  /// Waits for data, at most `wait_s`, and passes all of it to `sink`. Looks for a box if none is open.
  virtual PortState poll(double wait_s, ReportSink& sink) = 0;

  /// Starts an OUT report. At most one is in flight; a pending one is replaced. Never blocks; dropped if no box is
  /// open.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;

  /// Vendor requests to the interface. They block up to half a second, and pass reports received meanwhile to the last
  /// `sink`. Returns the number of bytes read `into`; nullopt: the box refused (stall), or there is none.
  virtual std::optional<std::size_t> read(std::uint8_t request, std::span<std::uint8_t> into) = 0;
  virtual bool write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data = {}) = 0;

  virtual const PortIdentity& identity() const = 0;  ///< of the open box, or the last one
  virtual const PortCounts& counts() const = 0;
  virtual double now_s() const = 0;  ///< the clock used for timeouts
};

}  // namespace ostium::device
