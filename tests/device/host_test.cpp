/// The whole path, from bytes to a step's inputs and back to bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/base/tolerances.h"
#include "device/emulator/emulated_box.h"
#include "device/host/clamp.h"
#include "device/host/drive.h"
#include "device/host/link.h"

namespace ostium::device {
namespace {

using InReportBytes = std::array<std::uint8_t, in_report_bytes>;

/// The host's side, as a session holds it.
struct Host {
  Calibration calibration;
  LinkState link;
  TrackingState tracking;
  StrokeState hands;
  ClampState clamp;
  std::array<PendingDrive, tools> pending{};
  std::array<core::RodInputs, tools> inputs{};

  /// Takes one report, makes one step's inputs, returns one report.
  OutReport step(const InReportBytes& bytes, ClampLoad load = {}) {
    const auto report = received(bytes, link);
    if (!report) return {};
    const Movements m = movements(calibration, *report, tracking);
    const auto moved = follow({}, m, hands);
    ClampRequest request;
    request.arm = true, request.paused = hands.pause != Pause::none;
    request.load.fill(load);
    advance_clamps({}, request, m, clamp);
    for (std::size_t i = 0; i < tools; ++i) {
      collect(moved[i], pending[i]);
      drive(Eigen::Vector3d::UnitZ(), 1e-3, pending[i], inputs[i]);
    }
    return clamp_report(request, calibration, *report, clamp);
  }
};

/// Reports that keep the protocol's rules but are otherwise random.
TEST(HostChain, WildReportsStayWithinLimits) {
  Host host;
  plugged_in(host.link);
  std::mt19937_64 generator(11);
  const auto any = [&] { return static_cast<std::uint32_t>(generator()); };
  InReport r;
  for (int i = 0; i < 600'000; ++i) {
    const auto dice = any();
    r.sequence = dice % 100 == 0 ? any() : r.sequence + dice % 3;
    r.time_us = dice % 101 == 0 ? any() : r.time_us + 1000;
    r.armed = dice & 1, r.emergency_stop = dice % 97 == 0;
    r.last_out_sequence = static_cast<std::uint16_t>(any());
    const std::size_t k = any() % 4;
    r.insertion[k] =
        static_cast<std::int32_t>(dice % 7 ? static_cast<std::uint32_t>(r.insertion[k]) + any() % 40 : any());
    r.roll[k] = static_cast<std::int32_t>(any());
    r.quality[k] = static_cast<std::uint8_t>(any()), r.tool[k] = static_cast<Tool>(any() % 5);
    const OutReport out = host.step(bytes_of(r), {std::ldexp(1.0, static_cast<int>(any() % 2000) - 900), -1e300});
    ASSERT_TRUE(parse_out_report(bytes_of(out)));
    for (std::size_t t = 0; t < tools; ++t) {
      ASSERT_TRUE(std::abs(host.inputs[t].feed_m_s) <= core::tolerances::max_drive_speed_m_s);
      ASSERT_TRUE(host.inputs[t].base.turn_rate_W_rad_s.norm() <= core::tolerances::max_drive_turn_rad_s * (1 + 1e-12));
      ASSERT_TRUE(std::isfinite(host.hands.tool[t].inserted_mm));
      ASSERT_TRUE(host.clamp.level_N[t] >= 0 && host.clamp.level_N[t] <= ClampSettings{}.most_N);
    }
    ASSERT_TRUE(host.hands.picture >= 0 && host.hands.picture <= 1);
  }
  EXPECT_EQ(host.link.taken, 600'000u);
}

/// A wire and a guide in strokes, with forces and pauses: the recorded bytes alone give the same inputs bit for bit.
TEST(HostChain, ReplaysFromItsRecordedBytes) {
  Host live;
  EmulatedBox box{live.calibration};
  std::vector<InReportBytes> recorded;
  std::vector<double> fed, again;
  box.station[0] = {Tool::guide, 200, 0, 0}, box.station[1] = {Tool::wire, 200, 0, 0};
  int pauses = 0;
  double way = 1;
  for (int i = 0; i < 20'000; ++i) {
    const bool paused = live.hands.pause != Pause::none;
    auto& wire = box.station[1];
    if (paused && way > 0) way = -1, ++pauses;
    if (!paused) way = 1;
    const bool there = paused && live.hands.tool[index_of(Tool::wire)].in_box_mm < 30;
    wire.advanced_mm += there ? 0 : 0.2 * way, wire.turned_deg += 0.7;
    box.station[0].advanced_mm += 0.003;
    recorded.push_back(box.sample());
    box.take(bytes_of(live.step(recorded.back(), {0.5, 1e-5})));
    for (const core::RodInputs& inputs : live.inputs)
      fed.push_back(inputs.feed_m_s), fed.push_back(inputs.base.turn_rate_W_rad_s.z());
  }
  EXPECT_GE(pauses, 4);
  EXPECT_GT(live.hands.tool[index_of(Tool::wire)].inserted_mm, 1000);

  Host replay;
  for (const InReportBytes& bytes : recorded) {
    replay.step(bytes, {0.5, 1e-5});
    for (const core::RodInputs& inputs : replay.inputs)
      again.push_back(inputs.feed_m_s), again.push_back(inputs.base.turn_rate_W_rad_s.z());
  }
  EXPECT_EQ(fed, again);
}

}  // namespace
}  // namespace ostium::device
