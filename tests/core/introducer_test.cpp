#include "core/rod/introducer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

Bench introducer(const RodDescription& wire, double inserted_m, bool gravity = true) {
  Bench bench = bench_of(wire, gravity);
  bench.state = make_state(bench.model, {along_x()}, {inserted_m});
  return bench;
}

RodDescription damped_wire() {
  RodDescription wire = steel_wire({.elements = 200, .length_m = 0.4});
  wire.damping.drag_across_N_s_m2 = wire.damping.drag_along_N_s_m2 = 0.05;
  return wire;
}

/// A partly inserted rod equals a rod made that short.
TEST(Introducer, APartlyInsertedRodIsAShorterRod) {
  RodDescription wire = damped_wire();
  wire.sections = {round_section(0, 0.1, 0.2e-3, 0, 60e9, 0.3, 6500),
                   round_section(0.1, 0.4, 0.45e-3, 0, 60e9, 0.3, 6500)};
  const double inserted = 0.1517;
  Bench part = introducer(wire, inserted);
  ASSERT_TRUE(part.settle().converged);

  RodDescription shorter = wire;
  const int first = part.rod().first;
  shorter.element_lengths_m.assign(wire.element_lengths_m.begin() + first, wire.element_lengths_m.end());
  shorter.element_lengths_m[0] = inserted - 0.002 * (200 - first - 1);
  Bench alone = introducer(shorter, inserted);
  ASSERT_TRUE(alone.settle().converged);
  EXPECT_LT((part.tip() - alone.tip()).norm(), 1e-12);
  part.step(), alone.step();
  EXPECT_LT((part.report.rods[0].base_torque_W_Nm - alone.report.rods[0].base_torque_W_Nm).norm(), 1e-9);
}

/// A straight weightless wire slides out along its axis by the length fed, with no force except for inertia.
TEST(Introducer, AStraightWireGoesWhereItIsFed) {
  Bench bench = introducer(damped_wire(), 0.05, false);
  bench.inputs.rods[0].feed_m_s = 0.1;
  double last = 0.05;
  for (int ms = 1; ms <= 2000; ++ms) {
    bench.step();
    EXPECT_EQ(bench.report.trouble, 0u) << ms;
    if (ms > 10) {
      EXPECT_NEAR(bench.tip().x() - last, 1e-4, 1e-9) << ms;
    }
    last = bench.tip().x();
  }
  EXPECT_NEAR(bench.tip().x(), 0.25, 1e-9);
  EXPECT_LT(std::hypot(bench.tip().y(), bench.tip().z()), 1e-12);
}

/// Turning a bent wire at the introducer turns its tip, whether fed or not.
TEST(Introducer, TurnsTheInstrument) {
  RodDescription wire = damped_wire();
  wire.sections[0].rest_curvature_per_m = Vector3d(0, 10, 0);  // towards d1, -z
  Bench bench = introducer(wire, 0.1, false);
  ASSERT_TRUE(bench.settle().converged);
  EXPECT_LT(bench.tip().z(), -0.04);
  bench.inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(units::pi, 0, 0);
  bench.inputs.rods[0].feed_m_s = 0.02;
  for (int ms = 0; ms < 500; ++ms) bench.step();
  bench.inputs.rods[0] = {};
  for (int ms = 0; ms < 3000; ++ms) bench.step();
  EXPECT_NEAR(bench.rod().inserted_m, 0.11, 1e-12);
  EXPECT_GT(bench.tip().y(), 0.04);  // right-handed about x: -z goes to y
  EXPECT_NEAR(bench.tip().z(), 0, 1e-6);
}

TEST(Introducer, StopsAtBothEndsOfTheInstrument) {
  Bench bench = introducer(damped_wire(), 0.39);
  bench.inputs.rods[0].feed_m_s = 0.1;
  for (int ms = 0; ms < 200; ++ms) bench.step();
  EXPECT_NEAR(bench.rod().inserted_m, 0.4, 1e-12);
  EXPECT_TRUE(bench.report.trouble & feed_stopped);
  bench.inputs.rods[0].feed_m_s = -0.5;
  for (int ms = 0; ms < 1000; ++ms) bench.step();
  EXPECT_EQ(bench.rod().inserted_m, 0);
  EXPECT_FALSE(in_body(bench.model.rods[0], bench.rod()));
  EXPECT_TRUE(bench.report.trouble & feed_stopped);
  EXPECT_EQ(bench.report.rods[0].push_N, 0);
}

/// Pulled out and pushed in again, the wire hangs as before.
TEST(Introducer, AWireThatWasWithdrawnWholeIsPutInAgain) {
  RodDescription wire = damped_wire();
  wire.sections[0].rest_curvature_per_m = Vector3d(0, 10, 0);
  Bench bench = introducer(wire, 0.1);
  ASSERT_TRUE(bench.settle().converged);
  const Vector3d tip = bench.tip();
  double largest_push = 0;
  const auto fed = [&](double length_m) {
    bench.inputs.rods[0].feed_m_s = length_m < 0 ? -0.05 : 0.05;
    for (int ms = 0; ms < std::lround(std::fabs(length_m) / 0.05e-3); ++ms) {
      bench.step();
      EXPECT_EQ(bench.report.trouble & ~feed_stopped, 0u);
      // The hand starts and stops within one step, so it pushes against the inertia of the inserted part.
      if (ms > 20) largest_push = std::max(largest_push, std::fabs(bench.report.rods[0].push_N));
    }
  };
  fed(-0.12), fed(0.1);
  bench.inputs.rods[0] = {};
  for (int ms = 0; ms < 5000; ++ms) bench.step();
  EXPECT_NEAR(bench.rod().inserted_m, 0.1, 1e-12);
  EXPECT_LT((bench.tip() - tip).norm(), 1e-6);
  EXPECT_LT(largest_push, 0.01);
}

TEST(Introducer, FeedsAtAnyAllowedSpeedAndLimitsTheRest) {
  for (double speed : {0.001, 0.2, 1.9, 50.0}) {
    Bench bench = introducer(damped_wire(), 0.05);
    for (int ms = 0; ms < 400; ++ms) {
      bench.inputs.rods[0].feed_m_s = ms % 100 < 50 ? speed : -speed;
      bench.step();
      ASSERT_TRUE(bench.tip().allFinite()) << speed << " " << ms;
      ASSERT_LT(bench.report.rods[0].stretch, 1e-4) << speed << " " << ms;
    }
    EXPECT_EQ((bench.report.trouble & drive_limited) != 0, speed > 2) << speed;
  }
}

/// The hand that holds a hanging wire carries the weight of the inserted part.
TEST(Introducer, FingersCarryTheWeightInside) {
  Bench bench = introducer(damped_wire(), 0.2);
  EndState down;  // d3 along -z
  down.q_W = turned_frame({1, 0, 0, 0}, Vector3d(units::pi, 0, 0));
  bench.state = make_state(bench.model, {down}, {0.2});
  for (int ms = 0; ms < 100; ++ms) bench.step();
  const double weight = 0.2 * steel_wire({}).sections[0].kg_per_m * 9.81;
  EXPECT_NEAR(bench.report.rods[0].push_N, -weight, 1e-9);  // pulled, not pushed
}

TEST(Introducer, ARunResumedWhileFeedingGoesOnBitIdentically) {
  const auto run = [](Bench& bench, int from, int to) {
    for (int ms = from; ms < to; ++ms) {
      bench.inputs.rods[0].feed_m_s = 0.3 * std::sin(0.01 * ms);
      bench.step();
    }
  };
  Bench whole = introducer(damped_wire(), 0.1);
  run(whole, 0, 1000);
  Bench first = introducer(damped_wire(), 0.1);
  run(first, 0, 317);
  Bench second = introducer(damped_wire(), 0.1);
  restore(save(first.state), second.state);
  run(second, 317, 1000);
  EXPECT_EQ(first_difference(whole.state, second.state), "");
}

/// The hash of a state ignores what is outside, since it has no effect even once fed in, except for the material's
/// memory.
TEST(Introducer, NothingComesOfWhatIsStillOutside) {
  RodDescription wire = damped_wire();
  wire.damping.material_time_s = 0.01;
  wire.relaxation = {{{0.2, 0.1}, {0.1, 1}}};
  Bench clean = introducer(wire, 0.1), soiled = introducer(wire, 0.1);
  RodState& rod = soiled.state.rods[0];
  const int outside = rod.first;
  ASSERT_GT(outside, 100);
  int fields = 0;
  for_each_field(rod, [&](const std::string_view name, auto& field) {
    if constexpr (requires { field.components; })
      for (int c = 0; c < field.components && field.size() > 0 && !name.starts_with("crept"); ++c, ++fields)
        std::fill_n(field.at(c), outside, 1e3);
  });
  EXPECT_GT(fields, 30);
  EXPECT_EQ(hash(soiled.state), hash(clean.state));
  for (int ms = 0; ms < 2000; ++ms) {
    for (Bench* bench : {&clean, &soiled}) {
      bench->inputs.rods[0].feed_m_s = ms < 1200 ? 0.15 : -0.1;  // in by 180 mm, out by 80 mm
      bench->step();
    }
    ASSERT_EQ(hash(soiled.state), hash(clean.state)) << ms;
  }
  const int inside = clean.rod().first;
  EXPECT_LT(inside, outside - 40);
  for (double* seen : {&clean.state.rods[0].strain.at(1)[inside + 1], &clean.state.rods[0].crept_slow.at(1)[2]}) {
    const double was = std::exchange(*seen, *seen + 1e-12);
    EXPECT_NE(hash(soiled.state), hash(clean.state));
    *seen = was;
  }
}

}  // namespace
}  // namespace ostium::core
