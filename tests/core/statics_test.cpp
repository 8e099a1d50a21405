#include "core/step/statics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "core/samples/steel_wire.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

/// Constant rest curvature and twist without load make a helix of radius k / (k^2 + t^2) and pitch 2 pi t / (k^2 +
/// t^2).
TEST(Statics, RestCurvatureAndTwistMakeAHelix) {
  RodDescription wire = steel_wire({.elements = 400, .length_m = 0.5});
  const double k = 40, t = 15, u = std::hypot(k, t);
  wire.sections[0].rest_curvature_per_m = Vector3d(0, k, t);
  Bench bench = bench_of(wire, false);
  ASSERT_TRUE(bench.settle().converged);
  // In the base frame the curve turns about the axis u = (0, k, t) / |u|: integrate d3 exactly.
  const Vector3d axis = Vector3d(0, k, t) / u, d3 = Vector3d::UnitZ();
  const double L = 0.5, angle = u * L;
  const Vector3d along = axis * axis.dot(d3), across = d3 - along;
  const Vector3d local = along * L + across * std::sin(angle) / u + axis.cross(across) * (1 - std::cos(angle)) / u;
  const Eigen::Vector4d q = along_x().q_W;
  EXPECT_LT((bench.tip() - Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * local).norm(), 1e-4 * L);
}

/// u1 > 0 turns d3 towards -d2, u2 > 0 turns d3 towards d1.
TEST(Statics, SignsOfRestCurvatureAreThoseOfTheFormat) {
  for (int axis : {0, 1}) {
    RodDescription wire = steel_wire({.elements = 32, .length_m = 0.1});
    wire.sections[0].rest_curvature_per_m[axis] = 2;
    Bench bench = bench_of(wire, false);
    ASSERT_TRUE(bench.settle().converged);
    const Eigen::Vector4d q = along_x().q_W;
    const Vector3d local = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * bench.tip();
    EXPECT_GT(axis == 0 ? -local.y() : local.x(), 0.009);
    EXPECT_NEAR(axis == 0 ? local.x() : local.y(), 0, 1e-12);
  }
}

/// P L^3 / 3 EI about each axis with its own stiffness; d1 is along -z, d2 along y.
TEST(Statics, BendingStiffnessDependsOnTheAxis) {
  RodDescription wire = steel_wire({.elements = 128, .length_m = 0.2});
  Section& s = wire.sections[0];
  s.EI2_N_m2 = 0.25 * s.EI1_N_m2;
  Bench bench = bench_of(wire, false);
  const double P = 1e-3, L = 0.2;
  bench.inputs.rods[0].tip_force_W_N = Vector3d(0, P, 0);  // bends about z, d1
  ASSERT_TRUE(bench.settle().converged);
  EXPECT_NEAR(bench.tip().y(), P * L * L * L / (3 * s.EI1_N_m2), 2e-4 * bench.tip().y());
  bench.inputs.rods[0].tip_force_W_N = Vector3d(0, 0, P);  // bends about y, d2
  ASSERT_TRUE(bench.settle().converged);
  EXPECT_NEAR(bench.tip().z(), P * L * L * L / (3 * s.EI2_N_m2), 2e-3 * bench.tip().z());
  EXPECT_NEAR(bench.tip().y(), 0, 1e-9);
}

/// The dynamic step, started at an equilibrium, stays there.
TEST(Statics, StepStaysWhereStaticsSettles) {
  RodDescription wire = steel_wire({.elements = 167, .length_m = 0.25});
  wire.sections[0].rest_curvature_per_m = Vector3d(4, 6, 1);
  Bench bench = bench_of(wire, true);
  bench.inputs.rods[0].tip_force_W_N = Vector3d(0.01, -0.02, 0.005);
  ASSERT_TRUE(bench.settle().converged);
  const Vector3d at_rest = bench.tip();
  for (int ms = 0; ms < 500; ++ms) bench.step();
  EXPECT_LT((bench.tip() - at_rest).norm(), 1e-9);
}

/// With both ends clamped, the rod bridges them: a clamped-clamped beam carries its weight with w L^2 / 12 at its ends.
TEST(Statics, ClampedAtBothEnds) {
  Bench bench = bench_of(steel_wire({.elements = 200, .E_Pa = 200e9, .length_m = 0.2}), true);
  bench.inputs.rods[0].tip.hold = Hold::guided;
  const RodEquilibrium found = bench.settle();
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.negative_directions, 0);
  bench.step();
  const Rod& rod = bench.model.rods[0];
  const double w = rod.total_mass_kg / rod.total_length_m * 9.81;
  EXPECT_NEAR(bench.report.rods[0].base_torque_W_Nm.norm(), w * 0.04 / 12, 1e-3 * w * 0.04 / 12);
}

/// Both ends slide along different lines, and each stays on its own.
TEST(Statics, TwoGuidedEndsStayOnTheirLines) {
  Bench bench = bench_of(steel_wire({.elements = 200, .length_m = 0.3}), false);
  RodState& rod = bench.rod();
  bench.inputs.rods[0].base.hold = Hold::guided;
  bench.inputs.rods[0].tip.hold = Hold::guided;
  rod.tip.q_W = turned_frame(along_x().q_W, Vector3d(0, units::pi / 2, 0));  // d3 along -z
  ASSERT_TRUE(bench.settle().converged);
  EXPECT_LT(rod.position[0].tail<2>().norm(), 1e-9);  // on x
  EXPECT_NEAR(bench.tip().x(), 0.3, 1e-9);            // on a vertical
  EXPECT_NEAR(bench.tip().y(), 0, 1e-9);
  const Vector3d tip = bench.tip();
  for (int ms = 0; ms < 100; ++ms) bench.step();
  EXPECT_LT((bench.tip() - tip).norm(), 1e-8);
}

/// A damped rod started in equilibrium stays at rest, too.
TEST(Statics, DampedEquilibriumStays) {
  RodDescription wire = steel_wire({.elements = 200, .length_m = 0.3});
  wire.damping.material_time_s = 1e-3;
  wire.sections[0].rest_curvature_per_m = Vector3d(4, 6, 1);
  Bench bench = bench_of(wire, true);
  ASSERT_TRUE(bench.settle().converged);
  const Vector3d tip = bench.tip();
  for (int ms = 0; ms < 100; ++ms) bench.step();
  EXPECT_LT((bench.tip() - tip).norm(), 1e-9);
}

TEST(Statics, WhatFallsForEverIsNotFound) {
  Bench bench = bench_of(steel_wire({.elements = 32}), true);
  bench.inputs.rods[0].base.hold = Hold::free;
  const std::uint64_t before = hash(bench.state);
  EXPECT_FALSE(bench.settle().converged);
  EXPECT_EQ(hash(bench.state), before);
}

/// From a straight shape to a hanging one, and for 250 mm of wire under changing loads (as in a fit).
TEST(Statics, ConvergesFromFarAndNear) {
  Bench far = bench_of(steel_wire({.elements = 512, .E_Pa = 1e9}), true);
  EXPECT_TRUE(far.settle().converged);

  RodDescription wire = steel_wire({.elements = 167, .length_m = 0.25});
  wire.sections[0] = round_section(0, 0.25, 0.178e-3, 0, 60e9, 0.3, 6500);
  Bench near = bench_of(wire, true);
  int most = 0;
  for (int k = 0; k < 50; ++k) {
    near.inputs.rods[0].tip_force_W_N = 1e-4 * Vector3d(std::sin(k), std::cos(2 * k), std::sin(3 * k));
    const RodEquilibrium found = near.settle();
    ASSERT_TRUE(found.converged);
    most = std::max(most, found.iterations);
  }
  EXPECT_LE(most, 12);  // about 0.03 ms each
}

}  // namespace
}  // namespace ostium::core
