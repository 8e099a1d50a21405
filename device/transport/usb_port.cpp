#include "device/transport/usb_port.h"

#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "device/protocol/report.h"
#include "device/transport/usb_box.h"

namespace ostium::device {

namespace {

constexpr std::size_t in_transfers = 8;
constexpr double look_every_s = 0.5, first_wait_s = 0.01, longest_wait_s = 0.16;
constexpr int most_failures = 5;  // in a row, before the box is opened anew

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

// --- the driver ------------------------------------------------------------------------------------------------------

struct UsbPort::Driver {
  UsbContext context;
  OpenUsbBox box;
  std::string serial;
  PortState state;
  PortCounts counts;
  ReportSink* sink = nullptr;

  struct In {
    Driver* driver = nullptr;
    libusb_transfer* transfer = nullptr;
    std::array<std::uint8_t, in_report_bytes> bytes{};
    bool in_flight = false;
  };
  std::array<In, in_transfers> in;
  libusb_transfer* out = nullptr;
  struct Out {
    std::array<std::uint8_t, brake_report_bytes> bytes{};
    std::size_t count = 0;
  } sending, next_out;
  bool out_in_flight = false, out_waits = false;

  libusb_hotplug_callback_handle hotplug = 0;
  bool has_hotplug = false;
  bool look = true;  ///< something was plugged in, or nothing was looked at yet
  double looked_s = 0;
  bool bringing_back = false;                  ///< transfers are not started again
  bool gone = false;                           ///< the box has left
  bool in_halted = false, out_halted = false;  ///< an endpoint stalled
  int failures = 0;                            ///< in a row
  double retry_s = 0;                          ///< not before

  explicit Driver(std::string of_serial) : serial(std::move(of_serial)) {
    for (In& i : in) i.driver = this, i.transfer = allocate();
    out = allocate();
    if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG))
      has_hotplug =
          libusb_hotplug_register_callback(
              context.usb, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
              LIBUSB_HOTPLUG_NO_FLAGS, usb_vendor, usb_product, LIBUSB_HOTPLUG_MATCH_ANY, plugged, this, &hotplug) == 0;
  }

  ~Driver() {
    sink = nullptr;  // it may be gone already
    close();
    if (has_hotplug) libusb_hotplug_deregister_callback(context.usb, hotplug);
    for (In& i : in) libusb_free_transfer(i.transfer);
    libusb_free_transfer(out);
  }

  static libusb_transfer* allocate() {
    libusb_transfer* made = libusb_alloc_transfer(0);
    if (!made) throw std::bad_alloc();
    return made;
  }

  static int plugged(libusb_context*, libusb_device* device, libusb_hotplug_event event, void* self) {
    auto& driver = *static_cast<Driver*>(self);
    if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED)
      driver.look = true;
    else if (driver.box.handle && libusb_get_device(driver.box.handle) == device)
      driver.gone = true;
    return 0;
  }

  // What libusb calls while events are handled.

  static void in_done(libusb_transfer* transfer) {
    In& i = *static_cast<In*>(transfer->user_data);
    i.in_flight = false;
    if (i.driver->may_go_on(*transfer, i.driver->in_halted, i)) i.driver->submit(i);
  }

  static void out_done(libusb_transfer* transfer) {
    auto& driver = *static_cast<Driver*>(transfer->user_data);
    driver.out_in_flight = false;
    if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
      ++driver.counts.out;
      if (driver.out_waits) driver.start_out();
      return;
    }
    driver.note(transfer->status, driver.out_halted);
  }

  bool may_go_on(const libusb_transfer& transfer, bool& halted, In& i) {
    if (transfer.status != LIBUSB_TRANSFER_COMPLETED) {
      note(transfer.status, halted);
      return false;
    }
    ++counts.in;
    failures = 0;
    state.trouble = PortTrouble::none;
    if (sink) sink->came({i.bytes.data(), static_cast<std::size_t>(transfer.actual_length)});
    return !gone && !in_halted && !bringing_back;
  }

  void note(libusb_transfer_status status, bool& halted) {
    switch (status) {
      case LIBUSB_TRANSFER_CANCELLED:
        return;
      case LIBUSB_TRANSFER_NO_DEVICE:
        gone = true;
        return;
      case LIBUSB_TRANSFER_STALL:
        if (!halted) ++counts.stalls, fail(PortTrouble::stalled);
        halted = true;
        return;
      default:  // an error, or more bytes than a report has
        ++counts.errors;
        fail(PortTrouble::failing);
    }
  }

  void fail(PortTrouble why) {
    if (now() < retry_s) return;  // the others of the eight, of the same moment
    ++failures;
    if (failures > 1) state.trouble = why;
    retry_s = now() + std::min(longest_wait_s, first_wait_s * (1 << std::min(failures - 1, 10)));
  }

  static double now() { return clock_s(); }

  void submit(In& i) {
    libusb_fill_interrupt_transfer(i.transfer, box.handle, box.interface.in, i.bytes.data(),
                                   static_cast<int>(i.bytes.size()), in_done, &i, 0);
    i.in_flight = submitted(i.transfer);
  }

  void start_out() {
    out_waits = false;
    sending = next_out;
    libusb_fill_interrupt_transfer(out, box.handle, box.interface.out, sending.bytes.data(),
                                   static_cast<int>(sending.count), out_done, this, 0);
    out_in_flight = submitted(out);
  }

  bool submitted(libusb_transfer* transfer) {
    const int error = libusb_submit_transfer(transfer);
    if (error == LIBUSB_ERROR_NO_DEVICE) gone = true;
    if (error != 0 && !gone) ++counts.errors, fail(PortTrouble::failing);
    return error == 0;
  }

  // Between events.

  bool in_flight() const {
    return out_in_flight || std::any_of(in.begin(), in.end(), [](const In& i) { return i.in_flight; });
  }

  void cancel_all() {
    for (In& i : in)
      if (i.in_flight) libusb_cancel_transfer(i.transfer);
    if (out_in_flight) libusb_cancel_transfer(out);
  }

  /// Every transfer is back, or a second is over.
  void bring_back() {
    bringing_back = true;
    out_waits = false;
    cancel_all();
    for (const double until = now() + 1; in_flight() && now() < until;) handle_events(0.05);
    bringing_back = false;
  }

  void handle_events(double wait_s) {
    timeval wait{static_cast<time_t>(wait_s),
                 static_cast<suseconds_t>(1e6 * (wait_s - static_cast<double>(static_cast<time_t>(wait_s))))};
    libusb_handle_events_timeout_completed(context.usb, &wait, nullptr);
  }

  void close() {
    if (!box.handle) return;
    state.open = false;
    bring_back();
    box.close();
    for (In& i : in) i.in_flight = false;
    out_in_flight = out_waits = false;
    look = true;
  }

  void find() {
    look = false;
    looked_s = now();
    state.trouble = PortTrouble::none;
    each_box(context.usb, [&](libusb_device* device) {
      const PortTrouble trouble = box.open(device, serial);
      if (trouble != PortTrouble::none) state.trouble = trouble;
      return box.handle != nullptr;
    });
    if (!box.handle) return;
    state = {true, state.openings + 1, PortTrouble::none};
    gone = in_halted = out_halted = false;
    failures = 0, retry_s = 0;
  }

  /// Clears stalls, waits after errors, keeps eight transfers in flight.
  void tend() {
    if (now() < retry_s) return;
    if (failures > most_failures) {
      const PortTrouble why = state.trouble;
      close();
      look = false, looked_s = now();  // not at once
      state.trouble = why;
      return;
    }
    if (in_halted || out_halted) {
      bring_back();
      if (in_halted) libusb_clear_halt(box.handle, box.interface.in);
      if (out_halted) libusb_clear_halt(box.handle, box.interface.out);
      in_halted = out_halted = false;
    }
    for (In& i : in)
      if (!i.in_flight && !gone && now() >= retry_s) submit(i);
    if (out_waits && !out_in_flight && !gone) start_out();
  }

  PortState poll(double wait_s) {
    if (gone) {
      ++counts.departures;
      close();
      gone = false;
    }
    if (!box.handle) {
      // Also without a box, so that what libusb hears of arrivals is heard.
      if (look || now() - looked_s > look_every_s) find();
      if (!box.handle) handle_events(std::min(wait_s, look_every_s));
      return state;  // once: what has been opened is asked before it streams
    }
    tend();
    if (box.handle) handle_events(now() < retry_s ? std::min(wait_s, first_wait_s) : wait_s);
    return state;
  }
};

UsbPort::UsbPort(std::string serial) : driver_(std::make_unique<Driver>(std::move(serial))) {}
UsbPort::~UsbPort() = default;

PortState UsbPort::poll(double wait_s, ReportSink& sink) {
  driver_->sink = &sink;
  return driver_->poll(wait_s);
}

void UsbPort::send(std::span<const std::uint8_t> bytes) {
  Driver& d = *driver_;
  if (!d.state.open || d.gone || bytes.size() > brake_report_bytes) return;
  if (d.out_waits) ++d.counts.replaced;
  std::copy(bytes.begin(), bytes.end(), d.next_out.bytes.begin());
  d.next_out.count = bytes.size();
  d.out_waits = true;
  if (!d.out_in_flight && !d.out_halted && clock_s() >= d.retry_s) d.start_out();
}

std::optional<std::size_t> UsbPort::read(std::uint8_t request, std::span<std::uint8_t> into) {
  if (!driver_->state.open) return {};
  return driver_->box.read(request, into);
}

bool UsbPort::write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) {
  return driver_->state.open && driver_->box.write(request, value, data);
}

const PortIdentity& UsbPort::identity() const { return driver_->box.identity; }
const PortCounts& UsbPort::counts() const { return driver_->counts; }
double UsbPort::now_s() const { return clock_s(); }

// --- looking around --------------------------------------------------------------------------------------------------

std::vector<FoundBox> find_boxes() {
  const UsbContext context;
  std::vector<FoundBox> boxes;
  each_box(context.usb, [&](libusb_device* device) {
    FoundBox found;
    OpenUsbBox box;
    found.trouble = box.open(device, "");
    found.identity = box.identity;
    if (box.handle) {
      std::array<std::uint8_t, info_bytes> info{};
      found.info =
          parse_info(std::span(info).first(box.read(static_cast<std::uint8_t>(Request::info), info).value_or(0)));
      std::array<std::uint8_t, calibration_bytes> record{};
      const auto count = box.read(static_cast<std::uint8_t>(Request::read_calibration), record);
      try {
        found.calibration = parse_calibration(std::span(record).first(count.value_or(0)));
      } catch (const CalibrationError& error) {
        found.calibration_problem = error.what();
      }
    }
    boxes.push_back(std::move(found));
    return false;
  });
  return boxes;
}

}  // namespace ostium::device
