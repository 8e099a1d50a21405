#pragma once
/// A tracking box on USB, by libusb: interrupt transfers, asynchronous.
///
/// Eight IN transfers are in flight, allocated once; one OUT transfer, and what waits behind it is replaced by what is
/// newer. Nothing is queued besides. (libusb itself allocates a request block whenever a transfer is submitted.)
/// Endpoints are found by direction and type. A box may be plugged in at any time, taken out, and plugged in again:
/// by hot-plug events, and a look around every half second for systems that have none, or whose permissions come late.
/// After an error it waits longer each time (10 to 160 ms), then opens the box anew; a stall is cleared. It never
/// spins.
#include <memory>
#include <vector>

#include "device/protocol/calibration.h"
#include "device/transport/control.h"
#include "device/transport/port.h"

namespace ostium::device {

inline constexpr std::uint16_t usb_vendor = 0x1209, usb_product = 0x0001;
inline constexpr std::uint8_t usb_class = 0xff, usb_subclass = 1, usb_protocol = 1;

/// A box that is plugged in, as `ostium device list` shows it.
struct FoundBox {
  PortIdentity identity;
  PortTrouble trouble = PortTrouble::none;
  std::optional<BoxInfo> info;             ///< as it answers
  std::optional<Calibration> calibration;  ///< its record
  std::string calibration_problem;         ///< why there is none
};

/// Throws std::runtime_error if libusb cannot be started, as everything here does.
std::vector<FoundBox> find_boxes();

class UsbPort : public Port {
 public:
  /// The box of this serial number; empty: the first that is found.
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
  struct Driver;  ///< libusb is seen in one source only
  std::unique_ptr<Driver> driver_;
};

}  // namespace ostium::device
