#pragma once
/// A bus with an emulated box, which libusb finds like any other device.
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

  /// Samples come every millisecond of clock time, or as soon as the host waits for one: then nothing depends on the
  /// clock, and time is the box's own.
  enum class Pace { real, fast, stepped };
  virtual void set_pace(Pace pace) = 0;
  /// With Pace::stepped, gives the next sample. False: the host does not wait for one.
  virtual bool step() { return false; }

  virtual bool can_deny() const { return false; }
  virtual void deny_access(bool) {}

  /// Whether the project's udev rule has tagged the box; nullopt: there is no udev here.
  virtual std::optional<bool> marked_by_udev() const { return {}; }

  /// Samples delayed because the host had no transfer in flight (test machines may be busy). After `longest_put_off_ms`
  /// they are lost, as on a bus, until the host is back.
  virtual long late() const = 0;
};

/// The bench that is available to this process; null, with the reason, if there is none.
std::unique_ptr<Bench> make_bench(std::string& why_not);
/// Call first in main: sets up the environment for the bench; may restart the program.
void prepare_bench(char** arguments);

Bench& bench();

}  // namespace ostium::test
