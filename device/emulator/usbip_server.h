#pragma once
/// An emulated box on a TCP port: any Linux machine can attach it as a real device (`usbip attach -r HOST -b 1-1`;
/// module vhci_hcd).
///
/// One thread and no call that blocks, so no host can hold up the end or another host. One host at a time has the box;
/// others are refused. A host that breaks the protocol, does not read, or is gone loses its connection, and nothing
/// else ends.
#include <list>
#include <optional>

#include "device/emulator/usbip_link.h"

namespace ostium::device {

class UsbipServer {
 public:
  static constexpr std::size_t most_asking = 16;         ///< hosts that have not asked yet; a next one drops the oldest
  static constexpr std::chrono::seconds time_to_ask{2};  ///< from connecting to the last byte of a request

  /// Throws std::runtime_error if the port is not available. `port` 0: any free one. `any_host`: accepts other machines
  /// as well as this one. `say`: takes lines for the operator.
  UsbipServer(EmulatedUsb& usb, std::uint16_t port, bool any_host, std::function<void(const std::string&)> say);

  std::uint16_t port() const;

  /// Serves hosts until `over`, which is asked at least every 50 ms.
  void serve(const std::function<bool()>& over);

 private:
  struct Asking {
    Connection connection;
    Connection::Clock::time_point until;
  };
  void wait();
  void serve_attached();
  void accept_host();
  bool is_done(Asking& host);
  void answer(const UsbipRequest& request, Connection& host);

  EmulatedUsb& usb_;
  std::function<void(const std::string&)> say_;
  Socket listener_;
  std::list<Asking> asking_;
  std::optional<UsbipLink> attached_;
  std::vector<pollfd> awaited_;
};

}  // namespace ostium::device
