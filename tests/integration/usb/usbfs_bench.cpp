/// Bench 1: the real libusb and libudev; umockdev simulates sysfs and uevents, and this file /dev/bus/usb/001/...:
/// libusb finds its `open`, `ioctl` and `close` before libc's; calls for other files are passed on.
///
/// The node's descriptor is the write end of a pipe with one slot: full, there is nothing to reap; drained, a transfer
/// is ready (POLLOUT, as in usbfs); with its reader closed, the box was unplugged (POLLERR).
#include "tests/integration/usb/usbfs_bench.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <stdexcept>
#include <thread>

namespace ostium::test {

namespace {

using namespace std::chrono_literals;

constexpr const char* preload = "libumockdev-preload.so.0";
constexpr char usb_nodes[] = "/dev/bus/usb/";

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

// A sanitizer that reports opens and closes files, and these must not report in their turn.
#define UNWATCHED __attribute__((no_sanitize_thread))

UNWATCHED int real_close(int fd) {
  static const auto call = next<int (*)(int)>("close");
  return call(fd);
}

/// One open file of the node.
struct Opening {
  int reader = -1, writer = -1;
  bool claimed = false;
  std::deque<usbdevfs_urb*> in, out, done;

  Opening() {
    int ends[2];
    if (pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    reader = ends[0], writer = ends[1];
    fcntl(writer, F_SETPIPE_SZ, 4096);
    fill();
  }
  ~Opening() {
    if (reader >= 0) real_close(reader);
  }
  void fill() {
    if (reader < 0) return;
    [[maybe_unused]] const auto count = write(writer, "x", 1);
  }
  void finish(usbdevfs_urb* urb, int status, int length) {
    urb->status = status, urb->actual_length = length;
    done.push_back(urb);
    char byte;
    if (done.size() == 1 && reader >= 0) [[maybe_unused]]
      const auto count = read(reader, &byte, 1);
  }
  void leave() {
    for (auto* list : {&in, &out})
      for (; !list->empty(); list->pop_front()) finish(list->front(), -ESHUTDOWN, 0);
    real_close(reader);
    reader = -1;
  }
};

class UsbfsBench : public Bench {
 public:
  UsbfsBench() : testbed_(umockdev_testbed_new()) {
    clock_ = std::thread([this] { run(); });
  }
  ~UsbfsBench() override {
    over_ = true;
    clock_.join();
    current = nullptr;  // a sanitizer opens files to its end
    g_object_unref(testbed_);
  }

  std::string name() const override { return "bench 1 (usbfs played, umockdev)"; }
  bool can_deny() const override { return true; }
  void set_pace(Pace pace) override { pace_ = pace; }
  bool step() override { return plugged_ && tick(false); }
  void deny_access(bool denied) override { denied_ = denied; }
  long late() const override { return late_; }

  void plug() override {
    std::string path;
    {
      const std::lock_guard guard(mutex_);
      ++number_;
      plugged_ = true;
      path = fmt::format("/devices/pci0000:00/usb1/1-{}", number_);
    }
    std::string hex;
    for (const auto& d : {device::device_descriptor(), device::configuration_descriptor()})
      for (const std::uint8_t b : d) hex += fmt::format("{:02X}", b);
    const std::string text = fmt::format(
        "P: {}\nN: bus/usb/001/{:03}\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: BUSNUM=001\nE: DEVNUM={:03}\n"
        "E: DEVNAME=/dev/bus/usb/001/{:03}\nE: MAJOR=189\nE: MINOR={}\n"
        "A: busnum=1\\n\nA: devnum={}\\n\nA: speed=12\\n\nA: bConfigurationValue=1\\n\nH: descriptors={}\n",
        path, number_, number_, number_, number_ - 1, number_, hex);
    GError* error = nullptr;
    if (!umockdev_testbed_add_from_string(testbed_, text.c_str(), &error)) throw std::runtime_error(error->message);
    sys_ = "/sys" + path;
    umockdev_testbed_uevent(testbed_, sys_.c_str(), "add");
  }

  void unplug() override {
    {
      const std::lock_guard guard(mutex_);
      if (!plugged_) return;
      plugged_ = false;
      for (auto& [fd, opening] : open_) opening->leave();
      usb.detached();
    }
    umockdev_testbed_uevent(testbed_, sys_.c_str(), "remove");
    umockdev_testbed_remove_device(testbed_, sys_.c_str());
  }

  /// One millisecond of the bus. False: no transfer waits, and nothing was sampled unless `even_if_lost`.
  bool tick(bool even_if_lost) {
    const std::lock_guard guard(mutex_);
    if (!plugged_) return true;
    for (auto& [fd, opening] : open_)
      for (; !opening->out.empty(); opening->out.pop_front()) {
        usbdevfs_urb* urb = opening->out.front();
        usb.out({static_cast<std::uint8_t*>(urb->buffer), static_cast<std::size_t>(urb->buffer_length)});
        opening->finish(urb, 0, urb->buffer_length);
      }
    for (auto& [fd, opening] : open_) {
      if (opening->in.empty()) continue;
      const device::EmulatedUsb::Sample sample = usb.sample();
      if (!sample.stall && !sample.error && sample.bytes.empty()) return true;
      usbdevfs_urb* urb = opening->in.front();
      opening->in.pop_front();
      const auto room = static_cast<std::size_t>(urb->buffer_length);
      std::copy_n(sample.bytes.begin(), std::min(room, sample.bytes.size()), static_cast<std::uint8_t*>(urb->buffer));
      const int length = static_cast<int>(std::min(room, sample.bytes.size()));
      const bool too_long = sample.bytes.size() > room;
      opening->finish(urb, sample.stall ? -EPIPE : sample.error ? -EPROTO : too_long ? -EOVERFLOW : 0, length);
      return true;
    }
    if (even_if_lost) usb.sample();
    return false;
  }

  // The node.

  static UsbfsBench* current;

  bool is_node(const char* path) {
    const std::lock_guard guard(mutex_);
    return plugged_ && fmt::format("{}001/{:03}", usb_nodes, number_) == path;
  }
  int open() {
    const std::lock_guard guard(mutex_);
    if (denied_) {
      errno = EACCES;
      return -1;
    }
    auto made = std::make_unique<Opening>();
    const int fd = made->writer;
    if (static_cast<std::size_t>(fd) >= ours_.size()) {
      errno = EMFILE;
      return -1;
    }
    open_[fd] = std::move(made);
    ours_[static_cast<std::size_t>(fd)] = true;
    return fd;
  }
  bool has(int fd) const {
    return fd >= 0 && static_cast<std::size_t>(fd) < ours_.size() && ours_[static_cast<std::size_t>(fd)];
  }
  void close(int fd) {
    const std::lock_guard guard(mutex_);
    ours_[static_cast<std::size_t>(fd)] = false;
    open_.erase(fd);
  }

  int ioctl(int fd, unsigned long request, void* argument) {
    const std::lock_guard guard(mutex_);
    Opening& opening = *open_.at(fd);
    const int error = answer(opening, request, argument);
    if (error == 0) return 0;
    errno = error;
    return -1;
  }

 private:
  void run() {
    auto due = std::chrono::steady_clock::now();
    int put_off = 0;
    while (!over_) {
      const bool real = pace_ != Pace::fast || !plugged_;
      due = real ? std::max(due + 1ms, std::chrono::steady_clock::now()) : std::chrono::steady_clock::now();
      if (real) std::this_thread::sleep_until(due);
      if (pace_ == Pace::stepped) continue;
      const bool sampled = tick(real && put_off >= longest_put_off_ms);
      put_off = sampled ? 0 : put_off + 1;
      if (sampled) continue;
      ++late_;
      if (!real) std::this_thread::sleep_for(10us);
    }
  }

  int answer(Opening& opening, unsigned long request, void* argument) {
    if (request == USBDEVFS_REAPURBNDELAY) {
      if (opening.done.empty()) return plugged_ ? EAGAIN : ENODEV;
      *static_cast<void**>(argument) = opening.done.front();
      opening.done.pop_front();
      if (opening.done.empty()) opening.fill();
      return 0;
    }
    if (opening.reader < 0) return ENODEV;
    switch (request) {
      case USBDEVFS_GET_CAPABILITIES:
        *static_cast<__u32*>(argument) = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                         USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
        return 0;
      case USBDEVFS_CLAIMINTERFACE:
        for (const auto& [fd, other] : open_)
          if (other.get() != &opening && other->claimed) return EBUSY;
        opening.claimed = true;
        return 0;
      case USBDEVFS_RELEASEINTERFACE:
        opening.claimed = false;
        return 0;
      case USBDEVFS_CLEAR_HALT: {
        const auto endpoint = static_cast<std::uint8_t>(*static_cast<unsigned*>(argument));
        const std::uint8_t setup[] = {0x02, 1, 0, 0, endpoint, 0, 0, 0};
        usb.control(setup, {});
        return 0;
      }
      case USBDEVFS_SUBMITURB:
        submit(opening, static_cast<usbdevfs_urb*>(argument));
        return 0;
      case USBDEVFS_DISCARDURB:
        for (auto* list : {&opening.in, &opening.out})
          if (const auto at = std::find(list->begin(), list->end(), argument); at != list->end()) {
            opening.finish(*at, -ENOENT, 0);
            list->erase(at);
            return 0;
          }
        return EINVAL;
      case USBDEVFS_GETDRIVER:
        return ENODATA;
      case USBDEVFS_SETCONFIGURATION:
        return 0;
    }
    return ENOTTY;
  }

  void submit(Opening& opening, usbdevfs_urb* urb) {
    if (urb->type == USBDEVFS_URB_TYPE_INTERRUPT) {
      (urb->endpoint & 0x80 ? opening.in : opening.out).push_back(urb);
      return;
    }
    auto* bytes = static_cast<std::uint8_t*>(urb->buffer);
    const auto length = static_cast<std::size_t>(urb->buffer_length) - 8;
    const bool in = bytes[0] & 0x80;
    const device::ControlReply reply = usb.control({bytes, 8}, {bytes + 8, in ? 0 : length});
    if (!reply) return opening.finish(urb, -EPIPE, 0);
    const std::size_t count = in ? std::min(length, reply->size()) : length;
    if (in) std::copy_n(reply->begin(), count, bytes + 8);
    opening.finish(urb, 0, static_cast<int>(count));
  }

  UMockdevTestbed* testbed_;
  std::mutex mutex_;
  std::map<int, std::unique_ptr<Opening>> open_;
  std::array<std::atomic<bool>, 1024> ours_{};  // descriptors that are keys of open_, told without a lock
  std::atomic<bool> plugged_ = false, over_ = false, denied_ = false;
  std::atomic<Pace> pace_ = Pace::real;
  std::atomic<long> late_ = 0;
  int number_ = 1;
  std::string sys_;
  std::thread clock_;
};

UsbfsBench* UsbfsBench::current = nullptr;

template <class Open>
UNWATCHED int open_with(const char* name, const char* path, int flags, mode_t mode) {
  // Told before any lock is taken: other files may be opened where ours is held.
  const bool usb = std::strncmp(path, usb_nodes, sizeof usb_nodes - 1) == 0;
  if (usb && UsbfsBench::current && UsbfsBench::current->is_node(path)) return UsbfsBench::current->open();
  return next<Open>(name)(path, flags, mode);
}

}  // namespace

std::unique_ptr<Bench> make_usbfs_bench(std::string& why_not) {
  if (!dlopen(preload, RTLD_LAZY | RTLD_NOLOAD)) {
    why_not = "umockdev's preload library is missing (package umockdev)";
    return nullptr;
  }
  auto made = std::make_unique<UsbfsBench>();
  UsbfsBench::current = made.get();
  return made;
}

void prepare_usbfs_bench(char** arguments) {
  if (std::getenv("UMOCKDEV_PRELOADED")) return;
  setenv("UMOCKDEV_PRELOADED", "1", 1);
  setenv("LD_PRELOAD", preload, 1);
  const char* options = std::getenv("ASAN_OPTIONS");
  setenv("ASAN_OPTIONS", (std::string(options ? options : "") + ":verify_asan_link_order=0").c_str(), 1);
  execv("/proc/self/exe", arguments);
}

}  // namespace ostium::test

// --- what libusb calls -----------------------------------------------------------------------------------------------

#pragma GCC visibility push(default)
extern "C" {

using ostium::test::UsbfsBench;

UNWATCHED int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const auto mode = static_cast<mode_t>(va_arg(list, unsigned));
  va_end(list);
  return ostium::test::open_with<int (*)(const char*, int, ...)>("open", path, flags, mode);
}

UNWATCHED int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const auto mode = static_cast<mode_t>(va_arg(list, unsigned));
  va_end(list);
  return ostium::test::open_with<int (*)(const char*, int, ...)>("open64", path, flags, mode);
}

int __open_2(const char* path, int flags) {  // NOLINT: its name
  return ostium::test::open_with<int (*)(const char*, int, ...)>("open", path, flags, 0);
}

int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list list;
  va_start(list, request);
  void* argument = va_arg(list, void*);
  va_end(list);
  if (UsbfsBench::current && UsbfsBench::current->has(fd)) return UsbfsBench::current->ioctl(fd, request, argument);
  static const auto call = ostium::test::next<int (*)(int, unsigned long, ...)>("ioctl");
  return call(fd, request, argument);
}

UNWATCHED int close(int fd) {
  if (UsbfsBench::current && UsbfsBench::current->has(fd)) UsbfsBench::current->close(fd);
  return ostium::test::real_close(fd);
}
}
#pragma GCC visibility pop
