#pragma once
/// A bus with an emulated box on it, on which libusb finds the box as it finds any.
#include <memory>
#include <string>

#include "device/emulator/emulated_usb.h"

namespace ostium::test {

inline constexpr int longest_put_off_ms = 200;

class Bench {
 public:
  virtual ~Bench() = default;

  device::EmulatedUsb usb{[] {
    device::Calibration c;
    c.serial = "OST-0001", c.date = 20260101;
    for (device::TrackCalibration& t : c.track) t.before_introducer_mm = 20;
    return c;
  }()};

  virtual void plug() = 0;
  virtual void unplug() = 0;
  virtual std::string name() const = 0;

  /// Samples fall every millisecond of the clock, or as soon as the host waits for one: then nothing depends on the
  /// clock, and time is the box's own.
  enum class Pace { real, fast, stepped };
  virtual void set_pace(Pace pace) = 0;
  /// With Pace::stepped, the next sample. False: the host does not wait for one.
  virtual bool step() { return false; }

  virtual bool can_deny() const { return false; }
  virtual void deny_access(bool) {}

  /// Whether udev has marked the box by the project's rule; nothing: there is no udev here.
  virtual std::optional<bool> marked_by_udev() const { return {}; }

  /// Samples that were put off because the host had no transfer in flight. (Machines that run tests are busy. After
  /// `longest_put_off_ms` they are lost, as on a bus, until the host is back.)
  virtual long late() const = 0;
};

/// The bench that this process can have; null, with the reason: none.
std::unique_ptr<Bench> make_bench(std::string& why_not);
/// Before anything else in main: what the bench needs in the environment; may start the program anew.
void prepare_bench(char** arguments);

Bench& bench();

}  // namespace ostium::test
