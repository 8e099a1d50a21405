#pragma once
/// What tests of the driver share: a host at the bench's box, plugged in and as new.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <functional>

#include "device/host/tracking_box.h"
#include "device/transport/usb_port.h"
#include "tests/integration/usb/bench.h"

namespace ostium::test {

inline constexpr std::size_t wire = index_of(device::Tool::wire), guide = index_of(device::Tool::guide);

inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Usb : testing::Test {
  void SetUp() override {
    bench().usb.set_hand({});
    bench().usb.with([](device::EmulatedBox& box, device::EmulatedFaults& faults) {
      faults = {};
      box.station = {};
      box.emergency_stop = box.over_temperature = false;
    });
    bench().set_pace(Bench::Pace::real);
    bench().deny_access(false);
    bench().plug();
  }
  void TearDown() override {
    if (HasFailure()) {
      const device::BoxSnapshot& n = box.now();
      std::printf("link %d, trouble %d, openings %u, reports %llu, ignored %llu, in %llu, errors %llu, stalls %llu\n",
                  static_cast<int>(n.link), static_cast<int>(n.trouble), n.openings,
                  static_cast<unsigned long long>(n.reports), static_cast<unsigned long long>(n.ignored),
                  static_cast<unsigned long long>(n.port.in), static_cast<unsigned long long>(n.port.errors),
                  static_cast<unsigned long long>(n.port.stalls));
    }
    bench().unplug();
  }

  device::UsbPort port;
  device::TrackingBox box{port, {}};
  device::BoxRequest request;

  /// Polls until `done`, for a limited time.
  template <class Done>
  bool until(Done done, double longest_s = 5) {
    for (const double end = now_s() + longest_s; now_s() < end;) {
      box.poll(0.02, request);
      if (done()) return true;
    }
    return false;
  }
  bool running() {
    return until([&] { return box.now().link == device::Link::running; });
  }
  void faults(const std::function<void(device::EmulatedFaults&)>& change) {
    bench().usb.with([&](device::EmulatedBox&, device::EmulatedFaults& f) { change(f); });
  }
  std::array<std::uint16_t, 4> clamps() {
    return bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { return b.clamp(); });
  }
};

}  // namespace ostium::test
