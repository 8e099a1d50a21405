/// The host's side of a box over an in-memory port: what the USB benches test on a bus, without one.
#include "device/host/tracking_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "device/emulator/emulated_port.h"
#include "device/emulator/stroking_hand.h"
#include "device/host/calibrating.h"
#include "device/host/round_trips.h"

namespace ostium::device {
namespace {

constexpr std::size_t wire_at = index_of(Tool::wire);

TEST(TrackingBox, FollowsAHandInStrokesInAndOut) {
  Calibration c;
  for (TrackCalibration& t : c.track) t.before_introducer_mm = 20;
  EmulatedBox box{c};
  StrokingHand hand;
  EmulatedPort port{box, [&](EmulatedBox& b) { hand.move(b); }};
  TrackingBox host{port, {}};
  int full = 0, empty = 0;
  double deepest_m = 0, most_in_box_m = 0, paused_fed_m = 0;
  Pause before = Pause::none;
  while (host.now().box_s < 60 && host.now().tool[wire_at].arrivals < 2) {
    const double fed_m = host.now().tool[wire_at].fed_m;
    host.poll(0, {});
    const BoxSnapshot& now = host.now();
    full += now.pause == Pause::travel_full && before != now.pause;
    empty += now.pause == Pause::travel_empty && before != now.pause;
    if (now.pause != Pause::none && before == now.pause) paused_fed_m += std::abs(now.tool[wire_at].fed_m - fed_m);
    before = now.pause;
    deepest_m = std::max(deepest_m, now.tool[wire_at].inserted_m);
    most_in_box_m = std::max(most_in_box_m, now.tool[wire_at].in_box_m);
  }
  EXPECT_EQ(full, 3);
  EXPECT_EQ(empty, 3);
  EXPECT_NEAR(deepest_m, 3 * 0.195 + 0.29, 1e-3);
  EXPECT_LE(most_in_box_m, 0.3);
  EXPECT_EQ(paused_fed_m, 0);
  EXPECT_EQ(host.now().tool[wire_at].arrivals, 2u) << "out, and a new one in";
  EXPECT_EQ(host.now().lost, 0u);
}

TEST(TrackingBox, PulledAndPutInAgainItGoesOnWhereItWas) {
  EmulatedBox box{{}};
  box.station[0] = {Tool::wire, 200, 0, 0};
  EmulatedPort port{box, {}};
  TrackingBox host{port, {}};
  const auto polls = [&](int n) {
    for (int i = 0; i < n; ++i) host.poll(0, {});
  };
  polls(10);
  box.station[0].advanced_mm = 50;
  polls(10);
  EXPECT_NEAR(host.now().tool[wire_at].fed_m, 0.05, 1e-8);
  port.plugged = false;
  polls(10);
  EXPECT_EQ(host.now().link, Link::unplugged);
  box.station[0].advanced_mm = 90;
  port.plugged = true;
  polls(10);
  EXPECT_EQ(host.now().link, Link::running);
  EXPECT_EQ(host.now().openings, 2u);
  EXPECT_NEAR(host.now().tool[wire_at].fed_m, 0.05, 1e-8);
  box.station[0].advanced_mm = 100;
  polls(10);
  EXPECT_NEAR(host.now().tool[wire_at].fed_m, 0.06, 1e-8);
  BoxRequest zeroed;
  zeroed.zeroings[wire_at] = 1;
  host.poll(0, zeroed);
  host.poll(0, zeroed);
  EXPECT_EQ(host.now().tool[wire_at].inserted_m, 0);
}

TEST(TrackingBox, ClosesAClampAndKnowsItsRoundTrip) {
  for (const int delay : {1, 5, 20}) {
    EmulatedBox box{{}};
    box.station[2] = {Tool::wire, 200, 0, 0};
    EmulatedPort port{box, [](EmulatedBox& b) { b.station[2].advanced_mm += 0.05; }, delay};
    TrackingBox host{port, {}};
    RoundTrips trips;
    BoxRequest request;
    request.arm = true;
    request.load[wire_at].push_N = 2;
    for (int i = 0; i < 2000; ++i) {
      request.step_s += 1e-3;
      host.poll(0, request);
      trips.add(host.now().round_trip);
    }
    EXPECT_NEAR(box.clamp()[2] / 65535.0 * 10, 2, 0.01);
    EXPECT_NEAR(trips.percentile_s(0.5), 1e-3 * delay, 0.03e-3 * delay);
    request.load[wire_at].push_N = 2;  // from here on the simulation stands still, and so does `step_s`
    for (int i = 0; i < 60; ++i) host.poll(0, request);
    EXPECT_EQ(box.clamp()[2], 0) << "loads of a step that is over open it";
  }
}

TEST(TrackingBox, AsksABoxForItsBrakesAndUsesThem) {
  for (const bool separate : {false, true}) {
    EmulatedBox box{{}};
    box.separate_brakes = separate;
    box.station[2] = {Tool::wire, 200, 0, 0};
    EmulatedPort port{box, [](EmulatedBox& b) { b.station[2].advanced_mm += 0.05, b.station[2].turned_deg += 1; }};
    const TrackingBoxSettings settings;
    TrackingBox host{port, settings};
    BoxRequest request;
    request.arm = true;
    request.load[wire_at] = {1.5, 2 * settings.clamp.radius_m[wire_at]};
    for (int i = 0; i < 2000; ++i) request.step_s += 1e-3, host.poll(0, request);
    EXPECT_EQ(host.info().separate_brakes, separate);
    EXPECT_NEAR(box.clamp()[2] / 65535.0 * 10, separate ? 1.5 : 2.5, 0.01);
    EXPECT_NEAR(box.rotary()[2] / 65535.0 * 10, separate ? 2 : 2.5, 0.01);
    EXPECT_NEAR(host.now().tool[wire_at].brake_Nm / settings.clamp.radius_m[wire_at], separate ? 2 : 0, 0.01);
  }
}

/// A box with wrong scales is calibrated with a ruler, full turns and a gauge: the scales are recovered.
TEST(Calibrating, FindsTheScalesOfABox) {
  Calibration truth;
  truth.track[1] = {0.0127f, -0.09f, 0.0021f, 20};
  truth.atm_per_count = 0.0012f, truth.pressure_offset_atm = -0.31f;
  truth.mL_s_per_count = 0.004f, truth.flow_offset_mL_s = 0.2f;
  EmulatedBox box{truth};
  box.station[1] = {Tool::wire, 200, 0, 0};
  const auto sample = [&] { return parse_in_report(box.sample()).value(); };
  Calibration found;
  const InReport begin = sample();
  box.station[1].advanced_mm = 200;
  const InReport pushed = sample();
  found.track[1] = with_length(found.track[1], pushed.insertion[1] - begin.insertion[1], 200);
  box.station[1].turned_deg = 3600;
  const InReport turned = sample();
  found.track[1] =
      with_turns(found.track[1], turned.insertion[1] - pushed.insertion[1], turned.roll[1] - pushed.roll[1], 10);
  EXPECT_NEAR(found.track[1].mm_per_count, 0.0127, 1e-6);
  EXPECT_NEAR(found.track[1].deg_per_count, -0.09, 1e-6);
  EXPECT_NEAR(found.track[1].cross_talk_mm_deg, 0.0021, 1e-5);
  EXPECT_THROW(with_length(found.track[1], 99, 200), CalibrationError);

  found = with_pressure_zero(found, sample().pressure);
  box.pressure_atm = 12;
  found = with_pressure(found, sample().pressure, 12);
  found = with_flow_zero(found, sample().flow);
  box.flow_mL_s = 2.5;
  found = with_volume(found, sample().flow * 4.0, 4, 10);
  for (const double atm : {-0.9, 0.0, 20.0}) {
    box.pressure_atm = atm;
    EXPECT_NEAR(pressure_atm(found, sample().pressure), atm, 0.003);
  }
  for (const double mL_s : {-3.0, 0.0, 5.0}) {
    box.flow_mL_s = mL_s;
    EXPECT_NEAR(flow_mL_s(found, sample().flow), mL_s, 0.01);
  }
}

}  // namespace
}  // namespace ostium::device
