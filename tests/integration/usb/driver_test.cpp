/// The driver against a box on a bus, whichever bench provides it, with the faults of a real one: pulled cables,
/// stalls, silence, another version, random bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>

#include "device/host/box_thread.h"
#include "device/transport/usb_port.h"
#include "tests/integration/usb/driver_fixture.h"

namespace ostium::test {
namespace {

TEST_F(Usb, IsFoundAndSaysWhatItIs) {
  ASSERT_TRUE(running());
  EXPECT_EQ(port.identity().serial, "OST-0001");
  EXPECT_EQ(port.identity().product, "Tracking box (emulated)");
  EXPECT_EQ(box.info().version, 1);
  EXPECT_EQ(box.info().tracks, 4);
  EXPECT_EQ(box.info().rate_Hz, 1000);
  EXPECT_TRUE(box.now().calibrated);
  EXPECT_EQ(box.calibration().date, 20260101u);
  const std::vector<device::FoundBox> found = device::find_boxes();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trouble, device::PortTrouble::in_use);
}

TEST_F(Usb, IsListed) {
  std::vector<device::FoundBox> found;
  for (const double end = now_s() + 5; now_s() < end && found.empty();) found = device::find_boxes();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trouble, device::PortTrouble::none);
  EXPECT_EQ(found[0].identity.serial, "OST-0001");
  ASSERT_TRUE(found[0].info);
  EXPECT_EQ(found[0].info->watchdog_ms, 50);
  ASSERT_TRUE(found[0].calibration) << found[0].calibration_problem;
}

TEST_F(Usb, LosesNothingAndIsQuick) {
  const char* asked = std::getenv("OSTIUM_USB_REPORTS");
  const std::uint64_t reports = asked ? std::strtoull(asked, nullptr, 10) : 5000;
  ASSERT_TRUE(running());
  const std::uint64_t first = box.now().reports;
  const std::uint32_t first_sequence = box.now().sequence;
  const long late = bench().late();
  const double begin_s = now_s();
  std::vector<double> round_trips;
  std::uint64_t seen = box.now().round_trip.count;
  ASSERT_TRUE(until(
      [&] {
        if (box.now().round_trip.count > seen) round_trips.push_back(box.now().round_trip.last_s);
        seen = box.now().round_trip.count;
        return box.now().reports >= first + reports;
      },
      10 + 0.01 * static_cast<double>(reports)));
  const double took_s = now_s() - begin_s;
  EXPECT_EQ(box.now().lost, 0u);
  EXPECT_EQ(box.now().ignored, 0u);
  EXPECT_EQ(box.now().sequence - first_sequence, box.now().reports - first);
  ASSERT_GT(round_trips.size(), reports / 4);
  std::sort(round_trips.begin(), round_trips.end());
  const auto at = [&](double share) {
    return 1e3 * round_trips[static_cast<std::size_t>(share * static_cast<double>(round_trips.size()))];
  };
  EXPECT_LT(at(0.5), 3);
  EXPECT_LT(at(0.99), 20);
  std::printf("%s: %llu reports, %.0f Hz, %llu lost, %ld put off; round trip median %.2f ms, 99 %% %.2f ms\n",
              bench().name().c_str(), static_cast<unsigned long long>(reports), static_cast<double>(reports) / took_s,
              static_cast<unsigned long long>(box.now().lost), bench().late() - late, at(0.5), at(0.99));
}

TEST_F(Usb, UnpluggedWithTransfersInFlightAndPluggedInAgain) {
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[0] = {device::Tool::wire, 200, 0, 0};
  });
  ASSERT_TRUE(running());
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { b.station[0].advanced_mm = 100; });
  ASSERT_TRUE(until([&] { return box.now().tool[wire].fed_m > 0.0999; }));
  for (int i = 1; i <= 3; ++i) {
    bench().unplug();
    ASSERT_TRUE(until([&] { return box.now().link == device::Link::unplugged; }));
    EXPECT_FALSE(advice(box.now()).empty());
    EXPECT_NEAR(box.now().tool[wire].fed_m, 0.1, 1e-5);
    box.poll(0.1, request);
    bench().plug();
    ASSERT_TRUE(running());
    EXPECT_GE(box.now().openings, static_cast<std::uint32_t>(i + 1));  // a box that is leaving may be opened once more
  }
  EXPECT_NEAR(box.now().tool[wire].fed_m, 0.1, 1e-5) << "unseen movement is not made up";
  ASSERT_TRUE(until([&] { return box.now().tool[wire].sight == device::ToolPresence::seen; }));
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { b.station[0].advanced_mm = 130; });
  ASSERT_TRUE(until([&] { return box.now().tool[wire].fed_m > 0.1299; }));
  EXPECT_NEAR(box.now().tool[wire].inserted_m, 0.11, 1e-5);
  EXPECT_EQ(box.now().tool[wire].arrivals, 1u) << "the same instrument goes on";
}

TEST_F(Usb, StallIsClearedAndStallThatStaysIsShown) {
  ASSERT_TRUE(running());
  faults([](device::EmulatedFaults& f) { f.stalled = true; });
  const std::uint64_t before = box.now().reports;
  ASSERT_TRUE(until([&] { return box.now().port.stalls > 0 && box.now().reports > before + 100; }));
  EXPECT_EQ(box.now().link, device::Link::running);
  faults([](device::EmulatedFaults& f) { f.stalled = f.stays_stalled = true; });
  ASSERT_TRUE(until([&] { return box.now().trouble == device::PortTrouble::stalled; }));
  ASSERT_TRUE(until([&] { return box.now().link != device::Link::running; }));
  EXPECT_NE(advice(box.now()).find("stall"), std::string::npos);
  const std::uint64_t stalls = box.now().port.stalls;
  const double end = now_s() + 0.5;
  until([&] { return now_s() > end; });
  EXPECT_LE(box.now().port.stalls - stalls, 60u) << "it waits between tries";
  faults([](device::EmulatedFaults& f) { f.stalled = f.stays_stalled = false; });
  EXPECT_TRUE(running());
  EXPECT_EQ(box.now().trouble, device::PortTrouble::none);
}

TEST_F(Usb, ErrorsAreTriedAgainNotSpunOn) {
  ASSERT_TRUE(running());
  std::atomic<int> overlong = 1;
  faults([&](device::EmulatedFaults& f) {
    f.mangle = [&](std::vector<std::uint8_t>& report) {
      if (overlong.exchange(0)) report.resize(80);
    };
  });
  const std::uint64_t before = box.now().reports;
  ASSERT_TRUE(until([&] { return box.now().port.errors > 0 && box.now().reports > before + 100; }))
      << "one is survived";
  EXPECT_EQ(box.now().openings, 1u);
  faults([](device::EmulatedFaults& f) { f.mangle = {}, f.garbled = true; });
  ASSERT_TRUE(until(
      [&] { return box.now().trouble == device::PortTrouble::failing && box.now().link != device::Link::running; }));
  EXPECT_NE(advice(box.now()).find("fail"), std::string::npos);
  const std::uint64_t errors = box.now().port.errors;
  const double end = now_s() + 1;
  until([&] { return now_s() > end; });
  EXPECT_LE(box.now().port.errors - errors, 300u) << "eight at a time, ever more seldom";
  faults([](device::EmulatedFaults& f) { f.garbled = false; });
  EXPECT_TRUE(running());
  EXPECT_EQ(box.now().trouble, device::PortTrouble::none);
}

TEST_F(Usb, SilenceIsShownAndOpensTheClamps) {
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[0] = {device::Tool::wire, 200, 0, 0};
  });
  bench().usb.set_hand(
      [](device::EmulatedBox& b) { b.station[0].advanced_mm += b.station[0].advanced_mm < 200 ? 0.05 : 0; });
  request.arm = true;
  request.load[wire] = {3, 0};
  ASSERT_TRUE(until([&] {
    request.step_s += 1e-3;
    return clamps()[0] > 15000;
  }));
  EXPECT_TRUE(box.now().armed);
  faults([](device::EmulatedFaults& f) { f.silent = true; });
  ASSERT_TRUE(until([&] { return box.now().link == device::Link::silent; }));
  ASSERT_TRUE(until([&] { return clamps()[0] == 0; })) << "nobody answers, so the watchdog opens them";
  faults([](device::EmulatedFaults& f) { f.silent = false; });
  ASSERT_TRUE(until([&] {
    request.step_s += 1e-3;
    return box.now().link == device::Link::running && box.now().armed && clamps()[0] > 0;
  })) << "and they close again by themselves";
}

TEST_F(Usb, AnotherVersionIsShown) {
  faults([](device::EmulatedFaults& f) { f.wrong_version = true; });
  ASSERT_TRUE(until([&] { return box.now().link == device::Link::wrong_version && box.now().ignored > 100; }));
  EXPECT_EQ(box.now().reports, 0u);
  EXPECT_EQ(box.now().tool[wire].fed_m, 0);
  bench().unplug();
  ASSERT_TRUE(until([&] { return box.now().link == device::Link::unplugged; }));
  faults([](device::EmulatedFaults& f) { f.wrong_version = false; });
  bench().plug();
  EXPECT_TRUE(running());
}

TEST_F(Usb, TheWatchdogOpensTheClampsOfAHostThatHangs) {
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[0] = {device::Tool::wire, 200, 0, 0};
  });
  std::atomic<double> closed_s = 0, open_s = 0;
  bench().usb.set_hand([&](device::EmulatedBox& b) {
    b.station[0].advanced_mm += b.station[0].advanced_mm < 200 ? 0.05 : 0;
    if (b.clamp()[0] > 0) closed_s = b.time_s();
    if (b.clamp()[0] == 0 && closed_s > 0 && open_s == 0) open_s = b.time_s();
  });
  request.arm = true;
  request.load[wire] = {3, 0};
  ASSERT_TRUE(until([&] {
    request.step_s += 1e-3;
    return clamps()[0] > 0;
  }));
  // No polls from here on; the eight transfers in flight still return.
  const double last_out_s =
      bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { return b.time_s(); });
  for (const double end = now_s() + 3; now_s() < end && open_s == 0;)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_GT(open_s, 0);
  EXPECT_LE(open_s - last_out_s, 0.060);
  std::printf("watchdog: clamps open %.0f ms of the box's time after the last answer\n", 1e3 * (open_s - last_out_s));
  bench().usb.set_hand({});
}

TEST_F(Usb, ABoxWithSeparateBrakesGetsThemApart) {
  ASSERT_TRUE(running());
  bench().unplug();
  ASSERT_TRUE(until([&] { return box.now().link == device::Link::unplugged; }));
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.separate_brakes = true;
    b.station[0] = {device::Tool::wire, 200, 0, 0};
  });
  bench().plug();
  ASSERT_TRUE(running());
  EXPECT_TRUE(box.info().separate_brakes);
  bench().usb.set_hand([](device::EmulatedBox& b) { b.station[0].turned_deg += 0.5; });
  request.arm = true;
  request.load[wire] = {0, 5e-4};
  EXPECT_TRUE(until([&] {
    request.step_s += 1e-3;
    return bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { return b.rotary()[0] > 0; });
  }));
  EXPECT_EQ(clamps()[0], 0) << "what resists turning does not hold back a push";
  bench().usb.set_hand({});
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { b.separate_brakes = false; });
}

/// Half of them keep all rules, half have bytes inverted: exactly those that keep the rules are accepted.
TEST_F(Usb, TenThousandWildReportsOnTheWire) {
  ASSERT_TRUE(running());
  bench().set_pace(Bench::Pace::fast);
  std::mt19937 generator(5);
  std::atomic<std::uint64_t> sent = 0, flawless = 0;
  faults([&](device::EmulatedFaults& f) {
    f.mangle = [&](std::vector<std::uint8_t>& report) {
      const auto any = [&](std::uint32_t below) { return generator() % below; };
      const std::uint32_t kind = any(4);
      if (kind == 1)
        for (std::uint32_t n = 1 + any(4); n > 0; --n) report[any(64)] = static_cast<std::uint8_t>(any(256));
      if (kind == 2)
        for (std::uint8_t& b : report) b = static_cast<std::uint8_t>(any(256));
      if (kind == 3) report.resize(1 + any(64));
      ++sent;
      flawless += device::flaw_of_in_report(report) == device::Flaw::none;
    };
  });
  const std::uint64_t taken = box.now().reports, ignored = box.now().ignored;
  ASSERT_TRUE(until([&] { return sent >= 10'000; }, 60));
  faults([](device::EmulatedFaults& f) { f.mangle = {}; });
  const std::uint64_t marker = box.now().reports;
  ASSERT_TRUE(until([&] { return box.now().reports > marker + 50; }));
  EXPECT_EQ(box.now().ignored - ignored, sent - flawless);
  EXPECT_GE(box.now().reports - taken, flawless);
  for (const device::ToolSnapshot& tool : box.now().tool) {
    EXPECT_TRUE(std::isfinite(tool.fed_m) && std::isfinite(tool.turned_rad));
    EXPECT_TRUE(tool.clamp_N >= 0 && tool.clamp_N <= device::ClampSettings{}.most_N);
  }
  EXPECT_TRUE(running());
}

TEST_F(Usb, CalibrationIsWrittenCheckedAndApplied) {
  ASSERT_TRUE(running());
  device::Calibration c = box.calibration();
  c.track[0].mm_per_count = 0.02f, c.date = 20260202;
  const auto record = bytes_of(c);
  auto damaged = record;
  damaged[30] ^= 1;
  EXPECT_FALSE(write_calibration(port, damaged)) << "the box looks at the CRC";
  EXPECT_TRUE(write_calibration(port, record));
  EXPECT_EQ(device::parse_calibration(read_calibration(port)).date, 20260202u);
  EXPECT_FALSE(port.write(0x55, 0, {})) << "unknown requests stall";
  EXPECT_FALSE(port.write(static_cast<std::uint8_t>(device::Request::watchdog_time), 9, {}));
  EXPECT_TRUE(running());
  request.arm = true;
  ASSERT_TRUE(until([&] { return box.now().armed; }));
  EXPECT_FALSE(write_calibration(port, record)) << "not while armed";
  request.arm = false;
  bench().unplug();
  ASSERT_TRUE(until([&] { return box.now().link == device::Link::unplugged; }));
  bench().plug();
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[0] = {device::Tool::wire, 200, 0, 0};
  });
  ASSERT_TRUE(running());
  EXPECT_EQ(box.calibration().date, 20260202u);
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { b.station[0].advanced_mm = 40; });
  ASSERT_TRUE(until([&] { return std::abs(box.now().tool[wire].fed_m - 0.04) < 2e-5; }));
}

TEST_F(Usb, ALostWireStandsStillAndIsFoundAgain) {
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[1] = {device::Tool::wire, 200, 0, 0};
  });
  ASSERT_TRUE(until([&] { return box.now().tool[wire].sight == device::ToolPresence::seen; }));
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { b.station[1].advanced_mm = 60; });
  ASSERT_TRUE(until([&] { return box.now().tool[wire].fed_m > 0.0599; }));
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) { b.station[1].quality = 3; });
  ASSERT_TRUE(until([&] { return box.now().tool[wire].sight == device::ToolPresence::lost; }));
  EXPECT_NE(advice(box.now()).find("does not see it"), std::string::npos);
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[1].advanced_mm = 90, b.station[1].quality = 200;
  });
  ASSERT_TRUE(until([&] { return box.now().tool[wire].sight == device::ToolPresence::seen; }));
  EXPECT_NEAR(box.now().tool[wire].fed_m, 0.06, 2e-5);
}

TEST_F(Usb, PressureFlowAndPedalsCome) {
  bench().usb.with(
      [](device::EmulatedBox& b, device::EmulatedFaults&) { b.pressure_atm = -0.9, b.flow_mL_s = 3.5, b.pedals = 3; });
  ASSERT_TRUE(until([&] { return box.now().pedals == 3; }));
  EXPECT_NEAR(box.now().pressure_Pa, -0.9 * 101325, 60);
  EXPECT_NEAR(box.now().flow_m3_s, 3.5e-6, 1e-8);
  bench().usb.with(
      [](device::EmulatedBox& b, device::EmulatedFaults&) { b.pressure_atm = 14, b.flow_mL_s = -2, b.pedals = 0; });
  ASSERT_TRUE(until([&] { return box.now().pedals == 0 && box.now().pressure_Pa > 0; }));
  EXPECT_NEAR(box.now().pressure_Pa, 14 * 101325, 60);
  EXPECT_NEAR(box.now().flow_m3_s, -2e-6, 1e-8);
}

TEST_F(Usb, NoAccessIsSaidAndMended) {
  if (!bench().can_deny()) GTEST_SKIP() << "root may open everything on " << bench().name();
  bench().deny_access(true);
  ASSERT_TRUE(until([&] { return box.now().trouble == device::PortTrouble::no_access; }));
  EXPECT_NE(advice(box.now()).find("udev"), std::string::npos);
  bench().deny_access(false);
  EXPECT_TRUE(running()) << "without being plugged in again";
}

TEST_F(Usb, TheUdevRuleMarksIt) {
  if (!bench().marked_by_udev()) GTEST_SKIP() << "no udev on " << bench().name();
  ASSERT_TRUE(running());
  EXPECT_TRUE(until([] { return *bench().marked_by_udev(); }));
}

TEST_F(Usb, AnotherProgramHasIt) {
  device::UsbPort first;
  device::TrackingBox owner{first, {}};
  for (const double end = now_s() + 5; now_s() < end && owner.now().link != device::Link::running;)
    owner.poll(0.02, {});
  ASSERT_TRUE(until([&] { return box.now().trouble == device::PortTrouble::in_use; }));
}

TEST_F(Usb, OnAThreadOfItsOwn) {
  device::BoxThread thread(std::make_unique<device::UsbPort>(), {});
  bench().usb.with([](device::EmulatedBox& b, device::EmulatedFaults&) {
    b.station[0] = {device::Tool::guide, 200, 0, 0};
  });
  bench().usb.set_hand([](device::EmulatedBox& b) { b.station[0].advanced_mm += 0.1; });
  double fed_m = 0;
  for (const double end = now_s() + 5; now_s() < end && fed_m < 0.1;) {
    const device::BoxSnapshot& now = thread.newest();
    EXPECT_GE(now.tool[guide].fed_m, fed_m);
    fed_m = now.tool[guide].fed_m;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GE(fed_m, 0.1);
}

}  // namespace
}  // namespace ostium::test
