/// Bench 2: a real Linux kernel's USB stack, udev and usbfs. The box speaks USB/IP on one end of a pair of sockets; the
/// other end is given to the kernel's virtual host controller (vhci_hcd). Runs as root in a virtual machine
/// (bench2.sh).
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "device/emulator/usbip_link.h"
#include "tests/integration/usb/bench.h"

namespace ostium::test {

namespace {

constexpr const char* controller = "/sys/devices/platform/vhci_hcd.0/";

/// False: the kernel refused.
bool tell(const char* what, const std::string& text) {
  const int file = open((std::string(controller) + what).c_str(), O_WRONLY | O_CLOEXEC);
  const bool done = file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (file >= 0) close(file);
  return done;
}

class VhciBench : public Bench {
 public:
  ~VhciBench() override { unplug(); }
  std::string name() const override { return "bench 2 (kernel, vhci_hcd)"; }
  void set_pace(Pace pace) override { fast_ = pace == Pace::fast; }
  long late() const override { return late_ + (link_ ? link_->late() : 0); }

  std::optional<bool> marked_by_udev() const override {
    const std::filesystem::path tags = "/run/udev/tags/uaccess";
    return std::filesystem::is_directory(tags) && !std::filesystem::is_empty(tags);
  }

  void plug() override {
    if (link_) return;
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw std::runtime_error("no sockets");
    over_ = false;
    link_ = std::make_unique<device::UsbipLink>(usb, device::Connection(ends[0]));
    thread_ = std::thread([this] { link_->serve(over_, &fast_); });
    bool attached = false;
    // A detached port becomes free a moment later.
    for (int tries = 0; tries < 200 && !attached; ++tries) {
      attached = tell("attach", fmt::format("0 {} {} {}", ends[1], device::usbip_device, device::usbip_speed));
      if (!attached) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    close(ends[1]);
    if (!attached) throw std::runtime_error("the kernel does not attach the box");
  }

  void unplug() override {
    if (!link_) return;
    tell("detach", "0");
    // vhci_hcd loses for good what is submitted while it shuts a connection down, so wait until it has finished.
    for (int tries = 0; tries < 500 && !port_is_free(); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    over_ = true;
    thread_.join();
    late_ += link_->late();
    link_.reset();
  }

 private:
  /// The controller's table then has the line "hs  0000 004 ..." for port 0.
  static bool port_is_free() {
    std::ifstream table(std::string(controller) + "status");
    std::string heading, hub, port, status;
    std::getline(table, heading);
    return !(table >> hub >> port >> status) || status == "004";
  }

  std::unique_ptr<device::UsbipLink> link_;
  std::thread thread_;
  std::atomic<bool> over_ = false, fast_ = false;
  long late_ = 0;
};

}  // namespace

std::unique_ptr<Bench> make_bench(std::string& why_not) {
  if (access((std::string(controller) + "attach").c_str(), W_OK) != 0) {
    why_not = "no virtual host controller here (vhci_hcd, as root)";
    return nullptr;
  }
  return std::make_unique<VhciBench>();
}

void prepare_bench(char**) {}

}  // namespace ostium::test
