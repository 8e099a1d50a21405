/// Dynamics compared with closed forms that are not among the gates of `ostium verify`.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "core/rod/inertia.h"
#include "core/samples/steel_wire.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;
using units::pi;

const Section& section(const RodDescription& wire) { return wire.sections[0]; }

/// A swing continues correctly when some of its steps are halved: the history is rescaled to the new steps.
TEST(Motion, HalvedStepsGoOnAlike) {
  const auto swing = [](bool halve) {
    Bench bench = bench_of(steel_wire({.elements = 100}), false);
    for (int i = 0; i <= 100; ++i) bench.rod().velocity.set(i, Vector3d(0, 1e-4 * i * i, 0));
    const auto run = [&](int steps) {
      for (int n = 0; n < steps; ++n) bench.step();
      return bench.tip();
    };
    run(50);
    if (halve) {
      rescale_history(bench.model.rods[0], 0.5, bench.rod());
      bench.model.step_s /= 2;
      run(40);
      bench.model.step_s *= 2;
      rescale_history(bench.model.rods[0], 2, bench.rod());
    } else {
      run(20);
    }
    return run(200);
  };
  const Vector3d as_ever = swing(false), halved = swing(true);
  ASSERT_GT(as_ever.y(), 0.05);
  EXPECT_LT((halved - as_ever).norm(), 0.005 * as_ever.y());
}

/// Euler-Bernoulli cantilever, first mode: omega = 1.8751^2 sqrt(EI / (rho A L^4)).
TEST(Motion, FirstBendingFrequencyOfACantilever) {
  const RodDescription wire = steel_wire({.elements = 100});
  Bench bench = bench_of(wire, false);
  for (int i = 0; i <= 100; ++i) bench.rod().velocity.set(i, Vector3d(0, 1e-4 * i * i, 0));
  std::vector<double> crossings_s;
  double before = 0;
  for (int ms = 1; ms <= 9000; ++ms) {
    bench.step();
    const double now = bench.rod().position[100].y();
    if (before < 0 && now >= 0) crossings_s.push_back(1e-3 * (ms - 1 + before / (before - now)));
    before = now;
  }
  ASSERT_GE(crossings_s.size(), 3u);
  const double period = (crossings_s.back() - crossings_s.front()) / static_cast<double>(crossings_s.size() - 1);
  const double omega = 1.8751 * 1.8751 * std::sqrt(section(wire).EI1_N_m2 / section(wire).kg_per_m);
  EXPECT_NEAR(2 * pi / period, omega, 0.01 * omega);
}

/// Numerical damping is small: a slow swing keeps its height.
TEST(Motion, SwingKeepsItsEnergy) {
  Bench bench = steel_bench({.elements = 100, .E_Pa = 200e9, .length_m = 0.4});
  double lowest = 0, highest_later = -1;
  for (int ms = 1; ms <= 3000; ++ms) {
    bench.step();
    lowest = std::min(lowest, bench.tip().z());
    if (ms > 2000) highest_later = std::max(highest_later, bench.tip().z());
  }
  EXPECT_LT(lowest, -0.03);
  EXPECT_NEAR(highest_later, 0, 0.05 * -lowest);
}

/// A free rod sinks through a fluid at m g = c_n L v across, and at m g = c_t L v along itself.
TEST(Damping, DragGivesTerminalVelocity) {
  for (bool across : {true, false}) {
    RodDescription wire = steel_wire({.elements = 32, .E_Pa = 200e9, .length_m = 0.1});
    wire.damping.drag_across_N_s_m2 = 0.7, wire.damping.drag_along_N_s_m2 = 0.35;
    Bench bench = bench_of(wire, true);
    bench.inputs.rods[0].base.hold = Hold::free;
    if (!across) bench.model.gravity_W = Vector3d(9.81, 0, 0);
    for (int ms = 0; ms < 300; ++ms) bench.step();
    const double c = across ? 0.7 : 0.35;
    EXPECT_NEAR(bench.rod().velocity[16].norm(), section(wire).kg_per_m * 9.81 / c, 1e-3 * 0.06) << across;
  }
}

/// Kelvin-Voigt: the first mode decays as exp(-tau omega^2 t / 2).
TEST(Damping, MaterialLossDampsLikeKelvinVoigt) {
  RodDescription wire = steel_wire({.elements = 64, .length_m = 0.3});
  const double omega = std::pow(1.8751 / 0.3, 2) * std::sqrt(section(wire).EI1_N_m2 / section(wire).kg_per_m);
  wire.damping.material_time_s = 0.05 / omega;  // 2.5 % of critical
  Bench bench = bench_of(wire, false);
  // The static shape under a tip load is 97 % first mode.
  bench.inputs.rods[0].tip_force_W_N = Vector3d(0, 1e-3, 0);
  ASSERT_TRUE(bench.settle().converged);
  bench.inputs.rods[0].tip_force_W_N.setZero();
  std::vector<double> peaks;
  double last = 0, now = 0;
  for (int ms = 0; ms < 3000; ++ms) {
    bench.step();
    const double next = bench.tip().y();
    if (now > last && now >= next && now > 0) peaks.push_back(now);
    last = now, now = next;
  }
  ASSERT_GE(peaks.size(), 6u);
  const double decrement = std::log(peaks[1] / peaks[5]) / 4;  // per period: pi tau omega
  EXPECT_NEAR(decrement, pi * 0.05, 0.05 * pi * 0.05);
}

/// The dynamic step leaves a straight column just above Euler's load, where the linear system says so, and not below.
TEST(Buckling, StepLeavesAColumnBeyondEulersLoad) {
  const double euler_N = std::pow(pi / 2, 2) * section(steel_wire({})).EI1_N_m2;
  const auto farthest = [&](double load) {
    Bench bench = steel_bench({.elements = 64, .gravity = false});
    bench.inputs.rods[0].tip_force_W_N = Vector3d(-load * euler_N, 0, 0);
    for (int i = 0; i <= 64; ++i) bench.rod().velocity.set(i, Vector3d(0, 1e-7 * i * i, 0));  // 0.4 mm/s at the tip
    double worst = 0;
    for (int ms = 0; ms < 20000; ++ms) {
      bench.step();
      worst = std::max(worst, std::fabs(bench.tip().y()));
    }
    return worst;
  };
  EXPECT_LT(farthest(0.95), 2e-3);
  EXPECT_GT(farthest(1.05), 0.05);
}

/// Bending and twist are coupled: a twisted rod whose ends approach forms a loop. (Later it passes through itself,
/// which nothing prevents here, and loses two turns.)
TEST(Looping, SlackTwistedEndsFormALoop) {
  const auto most_backwards = [](double turns) {
    RodDescription wire = steel_wire({.elements = 100});
    wire.damping.drag_across_N_s_m2 = wire.damping.drag_along_N_s_m2 = 0.05;
    Bench bench = bench_of(wire, false);
    RodInputs& in = bench.inputs.rods[0];
    in.tip.hold = Hold::clamped;
    for (int i = 40; i < 60; ++i) bench.rod().velocity.set(i, Vector3d(0, 1e-3, 0));
    in.tip.turn_rate_W_rad_s = Vector3d(turns * pi, 0, 0);
    for (int ms = 0; ms < 2000; ++ms) bench.step();
    in.tip.turn_rate_W_rad_s.setZero();
    in.tip.velocity_W_m_s = Vector3d(-0.1, 0, 0);
    double most = 1;
    for (int ms = 0; ms < 3000; ++ms) {
      bench.step();
      for (int i = 0; i < 100; ++i)
        most = std::min(most, (bench.rod().position[i + 1] - bench.rod().position[i]).normalized().x());
    }
    EXPECT_LT(bench.report.rods[0].stretch, 1e-6);
    return most;
  };
  EXPECT_GT(most_backwards(0), 0.2);   // without twist: a plane arch
  EXPECT_LT(most_backwards(4), -0.5);  // four turns: part of the rod runs backwards
}

/// A straight wire pushed against a fixed end yields sideways within a step or two, with a force of newtons, as in
/// dynamic buckling; an implicit step could also stay straight, with any force.
TEST(Buckling, PushedStraightWireGivesWayAtOnce) {
  for (double disturbance_m_s : {1e-3, 1e-6}) {
    Bench bench = steel_bench({.elements = 100, .gravity = false});
    RodInputs& in = bench.inputs.rods[0];
    in.tip.hold = Hold::clamped;
    for (int i = 40; i < 60; ++i) bench.rod().velocity.set(i, Vector3d(0, disturbance_m_s, 0));
    in.tip.velocity_W_m_s = Vector3d(-0.1, 0, 0);
    int troubled = 0;
    double force = 0;
    for (int ms = 0; ms < 300; ++ms) {
      bench.step();
      troubled += bench.report.trouble != 0;
      force = std::max(force, bench.report.rods[0].base_force_W_N.norm());
    }
    EXPECT_LE(troubled, 5);
    EXPECT_LT(force, 50);
    EXPECT_NEAR(bench.tip().x(), 0.97, 1e-9);
    EXPECT_LT(bench.report.rods[0].stretch, 1e-7);
  }
}

/// The tension between the held ends of a straight rod is the holding force, not noise.
TEST(Hold, StraightRodBetweenTwoClampsIsAtRest) {
  Bench bench = steel_bench({.elements = 128, .gravity = false});
  bench.inputs.rods[0].tip.hold = Hold::clamped;
  bench.inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(1, 0, 0);
  for (int ms = 0; ms < 500; ++ms) {
    bench.step();
    EXPECT_LT(bench.report.rods[0].base_force_W_N.norm(), 1e-3) << ms;
  }
}

/// Material damping brings a hanging wire to rest, whatever its amount.
TEST(Damping, MaterialLossBringsToRest) {
  for (double tau : {0.01, 0.03}) {
    RodDescription wire = steel_wire({.elements = 64, .length_m = 0.3});
    wire.damping.material_time_s = tau;
    Bench bench = bench_of(wire, true);
    for (int ms = 0; ms < 4000; ++ms) bench.step();
    EXPECT_LT(bench.rod().velocity[64].norm(), 1e-4) << tau;
    EXPECT_EQ(bench.report.trouble, 0u);
  }
}

/// The hand that turns a weightless wire feels the moment of the committed shape.
TEST(Reaction, TorqueIsThatOfTheCommittedShape) {
  Bench bench = steel_bench({.elements = 100, .gravity = false});
  bench.inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(30, 0, 0);
  const double GJ = section(steel_wire({})).GJ_N_m2;
  for (int ms = 0; ms < 100; ++ms) {
    bench.step();
    const Eigen::Vector4d a = bench.rod().base.q_W, b = bench.rod().orientation[0];
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(b[0], b[1], b[2], b[3]) * Eigen::Quaterniond(a[0], a[1], a[2], a[3]).conjugate();
    const double twist = 2 * std::atan2(turned.x(), turned.w()) / 0.005;  // over half an element
    EXPECT_NEAR(bench.report.rods[0].torque_Nm, -GJ * twist, 1e-12) << ms;
  }
}

/// A free rod in free fall has no reaction at its base.
TEST(Reaction, AFreeBaseFeelsNothing) {
  Bench bench = steel_bench({.elements = 16});
  bench.inputs.rods[0].base.hold = Hold::free;
  for (int ms = 0; ms < 10; ++ms) bench.step();
  EXPECT_EQ(bench.report.rods[0].base_force_W_N.norm(), 0);
}

/// Ordinary tensions converge in one iteration, for any element length.
TEST(Tension, IsNoTrouble) {
  for (int elements : {16, 100, 667})
    for (double newtons : {1.0, 20.0, 100.0}) {
      Bench bench = steel_bench({.elements = elements});
      bench.inputs.rods[0].tip_force_W_N = Vector3d(newtons, 0, 0);
      ASSERT_TRUE(bench.settle().converged);
      for (int ms = 0; ms < 50; ++ms) {
        bench.step();
        ASSERT_EQ(bench.report.trouble, 0u) << elements << " elements, " << newtons << " N";
        ASSERT_LE(bench.report.rods[0].iterations, 2);
      }
    }
}

TEST(Hold, GuidedEndSlidesAlongItsAxisOnly) {
  Bench bench = steel_bench({.elements = 64});
  bench.inputs.rods[0].tip.hold = Hold::guided;
  for (int ms = 0; ms < 3000; ++ms) bench.step();
  EXPECT_LT(bench.tip().x(), 1 - 1e-4);  // it sags, so the far end comes closer
  EXPECT_LT(std::hypot(bench.tip().y(), bench.tip().z()), 1e-12);
}

TEST(Reaction, HandCarriesTheWeightAtRest) {
  Bench bench = steel_bench({.elements = 64, .length_m = 0.3});
  ASSERT_TRUE(bench.settle().converged);
  bench.step();
  const double weight = bench.model.rods[0].total_mass_kg * 9.81;
  EXPECT_LT((bench.report.rods[0].base_force_W_N - Vector3d(0, 0, weight)).norm(), 1e-6 * weight);
  // Torque about the base: the weight acts at the centre of mass.
  Vector3d moment = Vector3d::Zero();
  for (int i = 0; i <= 64; ++i)
    moment += bench.rod().position[i].cross(bench.model.rods[0].mass.at(0)[i] * bench.model.gravity_W);
  EXPECT_LT((bench.report.rods[0].base_torque_W_Nm + moment).norm(), 1e-6 * moment.norm());
}

}  // namespace
}  // namespace ostium::core
