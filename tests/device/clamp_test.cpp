#include "device/host/clamp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <utility>

#include "core/base/units.h"
#include "device/emulator/emulated_box.h"

namespace ostium::device {
namespace {

constexpr std::size_t wire = index_of(Tool::wire);

Movements moved(double mm, double deg, double elapsed_s = 1e-3) {
  Movements m;
  m.elapsed_s = elapsed_s;
  m.tool[wire] = {true, mm, deg, 0};
  return m;
}

/// Level after moving one way against a load for a long time.
double settled_N(double mm, double deg, ClampLoad load, double age_s = 0, bool paused = false) {
  ClampState state;
  ClampRequest request;
  request.load[wire] = load, request.load_age_s = age_s, request.paused = paused;
  for (int i = 0; i < 1000; ++i) advance_clamps({}, request, moved(mm, deg), state);
  return state.level_N[wire];
}

TEST(Clamp, ResistsTheWayTheHandGoes) {
  const double r = ClampSettings{}.radius_m[wire];
  EXPECT_NEAR(settled_N(0.1, 0, {2, 0}), 2, 2e-3);  // held within a fraction of the perceptible change
  EXPECT_DOUBLE_EQ(settled_N(-0.1, 0, {2, 0}), 0);  // the load pushes back by itself: a brake would be in the way
  EXPECT_NEAR(settled_N(-0.1, 0, {-2, 0}), 2, 2e-3);
  EXPECT_NEAR(settled_N(0, 1, {0, 3 * r}), 3, 3e-3);
  EXPECT_DOUBLE_EQ(settled_N(0, -1, {0, 3 * r}), 0);
  EXPECT_NEAR(settled_N(0.1, 1, {4, 3 * r}), 5, 5e-3);
  EXPECT_DOUBLE_EQ(settled_N(0, 0, {2, 1}), 0);
}

/// Where turning has a brake of its own, what resists turning does not hold back a push, as one clamp for both does.
TEST(Clamp, SeparateBrakesHoldTheirOwnPart) {
  const double r = ClampSettings{}.radius_m[wire];
  for (const bool separate : {false, true}) {
    ClampState state;
    ClampRequest request;
    request.arm = true, request.separate_brakes = separate;
    request.load[wire] = {4, 3 * r};
    for (int i = 0; i < 1000; ++i) advance_clamps({}, request, moved(0.1, 1), state);
    EXPECT_NEAR(state.level_N[wire], separate ? 4 : 5, 5e-3);
    EXPECT_NEAR(state.rotary_N[wire], separate ? 3 : 0, 3e-3);
    InReport report;
    report.tool[1] = Tool::wire;
    const OutReport out = clamp_report(request, {}, report, state);  // 10 N at full scale
    EXPECT_NEAR(out.clamp[1], separate ? 26214 : 32768, 50);
    ASSERT_EQ(out.rotary.has_value(), separate);
    if (separate) {
      EXPECT_NEAR((*out.rotary)[1], 19661, 50);
    }
    request.load[wire] = {0, 3 * r};
    for (int i = 0; i < 1000; ++i) advance_clamps({}, request, moved(0.1, 1), state);
    EXPECT_NEAR(state.level_N[wire], separate ? 0 : 3, 3e-3);
    Movements lost = moved(0, 0);
    lost.tool[wire].seen = false;
    advance_clamps({}, request, lost, state);
    EXPECT_EQ(state.level_N[wire] + state.rotary_N[wire], 0);
  }
}

TEST(Clamp, KeepsItsLimits) {
  EXPECT_DOUBLE_EQ(settled_N(0.1, 0, {1e9, 0}), ClampSettings{}.most_N);
  EXPECT_DOUBLE_EQ(settled_N(0.1, 0, {std::nan(""), 0}), 0);
  EXPECT_DOUBLE_EQ(settled_N(0.1, 0, {std::numeric_limits<double>::infinity(), 0}), 0);
  EXPECT_DOUBLE_EQ(settled_N(0.1, 0, {2, 0}, 0.031), 0);
  EXPECT_DOUBLE_EQ(settled_N(0.1, 0, {2, 0}, 0, true), 0);
  ClampState state;
  ClampRequest request;
  request.load[wire].push_N = 5;
  for (int i = 0; i < 40; ++i) {
    const double before = state.level_N[wire];
    advance_clamps({}, request, moved(0.1, 0), state);
    EXPECT_LE(state.level_N[wire] - before, 0.1 + 1e-12);  // 100 N/s
  }
  Movements lost = moved(0, 0);
  lost.tool[wire].seen = false;
  advance_clamps({}, request, lost, state);
  EXPECT_EQ(state.level_N[wire], 0);
}

/// A hand on a wire in the emulated box, against an instrument: a compliant wall, and dry friction over the whole
/// length, which holds until it slips. There is a delay between hand and clamp, and sensor noise. When turning, the
/// hand is on a torque device of 2 mm radius; mm are measured at its rim.
struct Loop {
  bool turning = false;
  ClampSettings settings;
  double friction_N = 0.5, wall_N_m = 400, wall_at_mm = 20;
  int delay_ms = 20;

  Calibration calibration;
  EmulatedBox box{calibration};
  TrackingState tracking;
  ClampState clamp;
  std::mt19937 generator{7};
  std::deque<std::array<std::uint8_t, out_report_bytes>> underway;
  double hand_mm = 0, hand_mm_s = 0, sim_mm = 0, stuck_at_mm = 0, work_mJ = 0;

  double torquer_mm = 2, deg_mm = 180 / units::pi / torquer_mm;
  double lever() const { return turning ? 1e3 * settings.radius_m[wire] / torquer_mm : 1; }

  double level_N() const { return box.clamp()[0] / 65535.0 * calibration.clamp_full_scale_N[0]; }

  /// Hand of 0.1 kg, 300 N/m and 4 N s/m around its target; the clamp is dry friction.
  void move_hand(double wanted_mm) {
    const double dt = 1e-4, mass = 0.1;
    for (int i = 0; i < 10; ++i) {
      const double pull_N = 0.3 * (wanted_mm - hand_mm) - 4e-3 * hand_mm_s;
      const double free_mm_s = hand_mm_s + 1e3 * pull_N / mass * dt, brake_mm_s = 1e3 * lever() * level_N() / mass * dt;
      hand_mm_s = std::copysign(std::max(0.0, std::abs(free_mm_s) - brake_mm_s), free_mm_s);
      hand_mm += hand_mm_s * dt;
      work_mJ += pull_N * hand_mm_s * dt;
    }
  }

  double resistance_N(double advance_mm) {
    const double give_mm = 0.5;  // elastic travel of the instrument before it slips
    sim_mm += advance_mm;
    stuck_at_mm = std::clamp(stuck_at_mm, sim_mm - give_mm, sim_mm + give_mm);
    return friction_N * (sim_mm - stuck_at_mm) / give_mm + 1e-3 * wall_N_m * std::max(0.0, sim_mm - wall_at_mm);
  }

  void tick(double wanted_mm) {
    move_hand(wanted_mm);
    std::uniform_real_distribution<double> tremble_mm(-0.02, 0.02);
    const double seen_mm = hand_mm + tremble_mm(generator);
    box.station[0] = {Tool::wire, 200, turning ? 0 : seen_mm, turning ? deg_mm * seen_mm : 0};
    const InReport report = parse_in_report(box.sample()).value();
    const Movements m = movements(calibration, report, tracking);
    ClampRequest request;
    request.arm = true;
    if (turning)
      request.load[wire].torque_Nm = 1e-3 * torquer_mm * resistance_N(m.tool[wire].turn_deg / deg_mm);
    else
      request.load[wire].push_N = resistance_N(m.tool[wire].advance_mm);
    advance_clamps(settings, request, m, clamp);
    underway.push_back(bytes_of(clamp_report(request, calibration, report, clamp)));
    if (static_cast<int>(underway.size()) > delay_ms) box.take(underway.front()), underway.pop_front();
  }

  /// In, held, out, held: the level's total variation while the hand is held, in N per second; the largest.
  double buzz_N_s() {
    double worst = 0;
    for (const auto& [from_mm, to_mm] : {std::pair{0.0, 40.0}, {40.0, 10.0}, {10.0, 30.0}}) {
      for (int i = 0; i < 400; ++i) tick(from_mm + (to_mm - from_mm) * i / 400);
      for (int i = 0; i < 500; ++i) tick(to_mm);
      double path = 0;
      for (int i = 0; i < 1000; ++i) {
        const double before = level_N();
        tick(to_mm);
        path += std::abs(level_N() - before);
      }
      worst = std::max(worst, path);
    }
    return worst;
  }
};

void expect_no_buzz(Loop loop) {
  SCOPED_TRACE(std::to_string(loop.delay_ms) + " ms, " + std::to_string(loop.friction_N) + " N, wall " +
               std::to_string(loop.wall_N_m) + " N/m");
  Loop naive = loop;
  naive.settings.reversal_mm = naive.settings.reversal_deg = naive.settings.least_felt = naive.settings.smooth_s = 0;
  naive.settings.least_push_N = naive.settings.least_torque_Nm = 0;
  naive.settings.rise_N_s = naive.settings.fall_N_s = 1e6;
  EXPECT_LT(loop.buzz_N_s(), 0.1);
  EXPECT_GT(naive.buzz_N_s(), 100);
  EXPECT_GT(loop.level_N(), 0.9 * std::min(loop.friction_N / loop.lever(), loop.settings.most_N));
  EXPECT_GT(loop.work_mJ, 0);
  EXPECT_TRUE(parse_in_report(loop.box.sample())->armed);
}

/// Friction up to 16 times, a wall up to 25 times stiffer, delays up to 40 ms: while held, the level is constant. In
/// the same loop a clamp without dead bands and slew limit does buzz.
TEST(Clamp, NeverBuzzesHoweverHighTheFriction) {
  for (const int delay_ms : {1, 5, 20, 40})
    for (const double friction_N : {0.25, 1.0, 4.0})
      for (const double wall_N_m : {0.0, 400.0, 10'000.0}) {
        Loop loop;
        loop.delay_ms = delay_ms, loop.friction_N = friction_N, loop.wall_N_m = wall_N_m;
        expect_no_buzz(loop);
      }
}

/// The last of these frictions is more than the clamp can hold.
TEST(Clamp, NeverBuzzesWhenTurned) {
  for (const int delay_ms : {1, 5, 20, 40})
    for (const double friction_N : {0.2, 0.6, 2.4}) {
      Loop loop;
      loop.turning = true;
      loop.delay_ms = delay_ms, loop.friction_N = friction_N, loop.wall_N_m = 0;
      expect_no_buzz(loop);
    }
}

/// Small loads, for which sensor noise is relatively large: a clamp with only the relative dead band of a tenth wavers
/// by up to 27 N/s at 0.1 N.
TEST(Clamp, IsQuietUnderSmallLoads) {
  double follows_a_tenth = 0;
  for (const bool turning : {false, true})
    for (const int delay_ms : {1, 20, 40})
      for (const double friction_N : {0.0125, 0.025, 0.05, 0.1}) {
        Loop loop;
        loop.turning = turning;
        loop.delay_ms = delay_ms, loop.friction_N = friction_N, loop.wall_N_m = 0;
        Loop other = loop;
        other.settings.smooth_s = other.settings.least_push_N = other.settings.least_torque_Nm = 0;
        other.settings.settle_s = 0.02;
        EXPECT_LT(loop.buzz_N_s(), 0.1) << turning << ' ' << delay_ms << " ms " << friction_N << " N";
        follows_a_tenth = std::max(follows_a_tenth, other.buzz_N_s());
      }
  EXPECT_GT(follows_a_tenth, 5);
}

/// Friction increases while the wire is held, turned or pushed: the level grows with it and comes to rest.
TEST(Clamp, RestsWhileFrictionIsTurnedUp) {
  for (const bool turning : {false, true})
    for (const int delay_ms : {1, 40}) {
      Loop loop;
      loop.turning = turning;
      loop.delay_ms = delay_ms, loop.wall_N_m = 0;
      for (loop.friction_N = 0.1; loop.friction_N < 3.3; loop.friction_N *= 2) {
        const double from_mm = loop.hand_mm;
        for (int i = 0; i < 400; ++i) loop.tick(from_mm + 0.05 * i);
        for (int i = 0; i < 500; ++i) loop.tick(from_mm + 20);
        double path_N = 0;
        for (int i = 0; i < 1000; ++i) {
          const double before_N = loop.level_N();
          loop.tick(from_mm + 20);
          path_N += std::abs(loop.level_N() - before_N);
        }
        EXPECT_LT(path_N, 0.1) << turning << ' ' << delay_ms << " ms " << loop.friction_N << " N";
      }
      EXPECT_GT(loop.work_mJ, 0);
    }
}

/// The hand feels it: with the same effort the wire goes less deep.
TEST(Clamp, HoldsTheHandBack) {
  const auto depth_mm = [](double wall_N_m) {
    Loop loop;
    loop.friction_N = 0, loop.wall_N_m = wall_N_m;
    for (int i = 0; i < 3000; ++i) loop.tick(std::min(40.0, 0.02 * i));
    return loop.hand_mm;
  };
  EXPECT_NEAR(depth_mm(0), 40, 0.1);
  // Equilibrium of hand and wall: 300 (40 - x) = 400 (x - 20), less the effect of slew limit and delay.
  EXPECT_NEAR(depth_mm(400), (300 * 40 + 400 * 20) / 700.0, 1.5);
}

TEST(Clamp, ArmsAgainAfterTheWatchdogButNotAfterAStop) {
  Loop loop;
  for (int i = 0; i < 300; ++i) loop.tick(25);
  EXPECT_TRUE(parse_in_report(loop.box.sample())->armed);
  for (int i = 0; i < 60; ++i) loop.box.sample();  // the host stops responding
  EXPECT_FALSE(parse_in_report(loop.box.sample())->armed);
  for (int i = 0; i < 100; ++i) loop.tick(25);
  EXPECT_TRUE(parse_in_report(loop.box.sample())->armed);
  loop.box.emergency_stop = true;
  for (int i = 0; i < 100; ++i) loop.tick(25);
  loop.box.emergency_stop = false;
  for (int i = 0; i < 300; ++i) loop.tick(25);
  EXPECT_FALSE(parse_in_report(loop.box.sample())->armed);
}

}  // namespace
}  // namespace ostium::device
