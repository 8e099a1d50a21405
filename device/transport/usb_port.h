#pragma once
/// A tracking box on USB, with asynchronous interrupt transfers by libusb.
///
/// Eight IN transfers, allocated once, are in flight, and one OUT transfer; a pending OUT report is replaced by a newer
/// one. Nothing else is queued. (libusb itself allocates a request block whenever a transfer is submitted.) Endpoints
/// are found by direction and type. A box may be plugged in, removed and plugged in again at any time: it is detected
/// by hot-plug events, and by a scan every half second for systems that have none or grant permissions late. After an
/// error it waits longer each time (10 to 160 ms), then reopens the box; a stall is cleared. It never busy-waits.
#include <memory>
#include <vector>

#include "device/protocol/calibration.h"
#include "device/transport/control.h"
#include "device/transport/port.h"

namespace ostium::device {

inline constexpr std::uint16_t usb_vendor = 0x1209, usb_product = 0x0001;
inline constexpr std::uint8_t usb_class = 0xff, usb_subclass = 1, usb_protocol = 1;

/// A connected box, as `ostium device list` shows it.
struct FoundBox {
  PortIdentity identity;
  PortTrouble trouble = PortTrouble::none;
  std::optional<BoxInfo> info;             ///< its answer to the info request
  std::optional<Calibration> calibration;  ///< its record
  std::string calibration_problem;         ///< why there is none
};

/// Throws std::runtime_error if libusb cannot be started, like all functions here.
std::vector<FoundBox> find_boxes();

class UsbPort : public Port {
 public:
  /// The box with this serial number; empty: the first one found.
  explicit UsbPort(std::string serial = "");
  ~UsbPort() override;

  PortState poll(double wait_s, ReportSink& sink) override;
  void send(std::span<const std::uint8_t> bytes) override;
  std::optional<std::size_t> read(std::uint8_t request, std::span<std::uint8_t> into) override;
  bool write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) override;
  const PortIdentity& identity() const override;
  const PortCounts& counts() const override;
  double now_s() const override;

 private:
  struct Driver;  ///< hides libusb from other sources
  std::unique_ptr<Driver> driver_;
};

}  // namespace ostium::device
