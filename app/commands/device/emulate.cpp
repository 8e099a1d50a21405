#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "app/command_line/interrupt.h"
#include "app/commands/device/device.h"
#include "data/formats/load_error.h"
#include "device/emulator/stroking_hand.h"
#include "device/emulator/usbip_server.h"

namespace ostium::app {

namespace {

struct Arguments {
  double seconds = 0;  ///< 0: until Ctrl-C
  int port = device::usbip_port;
  bool any_host = false;  ///< also answers other machines
  bool still = false;     ///< do not move the emulated tools
  bool separate_brakes = false;
};

void declare(Options& options, Arguments& a) {
  options.add("--port", a.port, "TCP port").range(1, 65535).show_default();
  options.flag("--any-host", a.any_host, "For other machines too, not for this one alone");
  options.flag("--still", a.still, "Nobody moves its tools");
  options.flag("--separate-brakes", a.separate_brakes, "With a brake for pushing and one for turning on each track");
  options.add("--seconds", a.seconds, "Then end; else at Ctrl-C").range(0.01, 1e6);
}

std::unique_ptr<device::UsbipServer> make_server(const Arguments& a, device::EmulatedUsb& usb) try {
  return std::make_unique<device::UsbipServer>(usb, static_cast<std::uint16_t>(a.port), a.any_host,
                                               [](const std::string& what) { fmt::print(stderr, "{}\n", what); });
} catch (const std::runtime_error& error) {
  throw data::LoadError(error.what());
}

int run(const Arguments& a) {
  stop_on_signals();
  device::Calibration c;
  c.serial = device::emulated_serial;
  for (device::TrackCalibration& track : c.track) track.before_introducer_mm = 20;
  device::EmulatedUsb usb(c);
  usb.with([&](device::EmulatedBox& box, device::EmulatedFaults&) { box.separate_brakes = a.separate_brakes; });
  device::StrokingHand hand;
  if (!a.still) usb.set_hand([&](device::EmulatedBox& box) { hand.move(box); });
  const auto server = make_server(a, usb);
  fmt::print(stderr,
             "an emulated box on port {}; on Linux, as root:\n  modprobe vhci_hcd && usbip attach -r {} -b 1-1\n"
             "Ctrl-C ends it\n",
             a.port, a.any_host ? "THIS_MACHINE" : "127.0.0.1");
  const double begin_s = clock_s();
  server->serve([&] { return interrupted || (a.seconds > 0 && clock_s() >= begin_s + a.seconds); });
  return 0;
}

}  // namespace

Command device_emulate_command() {
  return make_command("emulate", "An emulated box on the network, by USB/IP",
                      {"ostium device emulate", "ostium device emulate --any-host --port 3241"}, declare, run);
}

}  // namespace ostium::app
