/// Nested instruments on one centreline compared with a boundary-value solver, and with core/nesting, where rods have
/// clearance.
#include "core/concentric_tubes/concentric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/step/step.h"
#include "tests/support/boundary_value.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

Section stretch(double from_m, double to_m, double EI_N_m2, const Vector3d& rest, double radius_m, double bore_m) {
  Section s;
  s.from_tip_m = from_m, s.to_tip_m = to_m;
  s.EI1_N_m2 = s.EI2_N_m2 = EI_N_m2, s.GJ_N_m2 = EI_N_m2 / 1.4;
  s.kg_per_m = 2.5e-3;
  s.radius_m = radius_m, s.inner_radius_m = bore_m;
  s.rest_curvature_per_m = rest;
  return s;
}

/// Two tubes with curved ends, 110 and 150 mm inserted.
boundary_value::Problem two_tubes(double roll_rad, double shaft_rad_per_Nm, const Vector3d& tip_force, bool gravity) {
  boundary_value::Problem p;
  p.tubes = {
      {{stretch(0, 0.05, 5.5e-3, {0, 13.6, 0}, 1.65e-3, 1.4e-3),
        stretch(0.05, 0.14, 5.5e-3, {0, 0, 0}, 1.65e-3, 1.4e-3)},
       0.110,
       -0.4,
       shaft_rad_per_Nm},
      {{stretch(0, 0.06, 2.6e-3, {0, 12.7, 0}, 1.32e-3, 1e-3), stretch(0.06, 0.22, 2.6e-3, {0, 0, 0}, 1.32e-3, 1e-3)},
       0.150,
       roll_rad,
       2 * shaft_rad_per_Nm}};
  p.tip_force = tip_force;
  if (gravity) p.gravity = {0, -9.81, 0};
  return p;
}

/// Largest distance between the solver's points and the nest's nodes at the same arc length, mm.
double distance_mm(const boundary_value::Problem& p, int elements, ConcentricEquilibrium* report = nullptr) {
  ConcentricDescription d;
  d.name = "nest";
  double length = 0;
  for (const auto& t : p.tubes) {
    d.parts.push_back({t.sections, t.inserted_m, t.roll_rad, t.shaft_rad_per_Nm});
    length = std::max(length, t.inserted_m);
  }
  d.element_lengths_m.assign(elements, length / elements);
  for (const boundary_value::Load& load : p.loads) {
    const int pieces = load.to_base_m > load.from_base_m ? 400 : 1;
    for (int i = 0; i < pieces; ++i)
      d.loads.push_back({load.from_base_m + (i + 0.5) * (load.to_base_m - load.from_base_m) / pieces,
                         load.force / static_cast<double>(pieces)});
  }
  const Concentric nest = make_concentric(d, p.gravity);
  ConcentricState state = straight_state(nest, {});
  const ConcentricEquilibrium found = find_equilibrium(nest, {}, p.tip_force, state);
  EXPECT_TRUE(found.converged) << found.rounds << " rounds, " << found.turn_rad << " rad";
  if (report) *report = found;
  const boundary_value::Solution exact = boundary_value::solve(p, elements + 1);
  EXPECT_TRUE(exact.converged) << exact.mismatch;
  double worst = 0;
  for (int i = 0; i <= elements && exact.converged; ++i)
    worst = std::max(worst, 1e3 * (state.carrier.rods[0].position[i] - exact.curve.at(i)).norm());
  return worst;
}

/// From a straight start, for any softening moment and ratio: where the two slopes differ by more than a factor of
/// three, full Newton steps would oscillate across the bend for ever.
TEST(Concentric, AWireThatSoftens) {
  boundary_value::Problem p;
  p.tubes = {{{stretch(0, 0.06, 7e-6, {18, -16, 0}, 0.2e-3, 0), stretch(0.06, 0.6, 75e-6, {0, 0, 0}, 0.2e-3, 0)},
              0.18,
              -2.3,
              0}};
  for (Section& s : p.tubes[0].sections) s.kg_per_m = 0.92e-3;
  p.gravity = {0, 0, -9.81};
  for (double force_N : {0.0, 3e-4})
    for (double per_m : {0.3, 3.0, 10.0})
      for (double ratio : {0.3, 0.2, 0.1, 0.05}) {
        for (Section& s : p.tubes[0].sections) s.softening_per_m = per_m, s.softened_ratio = ratio;
        p.tip_force = force_N * Vector3d(0.5, -0.3, 0.8);
        EXPECT_LT(distance_mm(p, 120), ratio < 0.2 ? 0.18 : 0.05) << force_N << " N, " << per_m << " per m, " << ratio;
      }
}

TEST(Concentric, TwoTubesTurnedAgainstEachOther) {
  for (double roll : {0.0, 0.5, 1.3, 2.2})
    for (double shaft : {0.0, 30.0})
      EXPECT_LT(distance_mm(two_tubes(roll, shaft, Vector3d::Zero(), false), 150), 0.005) << roll << " " << shaft;
}

TEST(Concentric, TheSameWithLoads) {
  ConcentricEquilibrium report;
  for (double shaft : {0.0, 30.0}) {
    EXPECT_LT(distance_mm(two_tubes(1.0, shaft, {0.05, -0.08, 0.03}, true), 150, &report), 0.005);
    EXPECT_LT(report.rounds, 30);
  }
}

/// One wire with rest twist, different stiffness about each axis, softening, a weight and a sideways load.
TEST(Concentric, OneWireWithEverything) {
  for (int what = 0; what < 5; ++what) {
    boundary_value::Problem p;
    p.tubes = {{{stretch(0, 0.05, 5e-6, {10, 5, 0}, 0.18e-3, 0), stretch(0.05, 0.6, 40e-6, {0, 0, 0}, 0.18e-3, 0)},
                0.25,
                0.7,
                0}};
    p.gravity = {0, -3, 0};
    p.tip_force = {4e-4, 3e-4, 0};
    for (Section& s : p.tubes[0].sections) {
      if (what == 0) s.rest_curvature_per_m.z() = 6;
      if (what == 1) s.EI1_N_m2 *= 1.6, s.EI2_N_m2 /= 1.6;
      if (what == 2) s.softening_per_m = 3, s.softened_ratio = 0.3;
    }
    if (what == 2) p.tip_force *= 0.4, p.gravity *= 0.4;  // otherwise beyond what it can bear from a straight start
    if (what == 3) p.loads = {{0.1512, 0.1512, {0, -3e-4, 0}}};
    if (what == 4) p.loads = {{0.05, 0.2, {6e-4, 0, 0}}};
    EXPECT_LT(distance_mm(p, 250), 0.02) << what;
  }
}

/// One wire: curved tip, rolled, heavy, loaded, and as long as the format's examples.
TEST(Concentric, OneWire) {
  boundary_value::Problem p;
  for (double roll : {0.0, 1.0, 2.5}) {
    p.tubes = {{{stretch(0, 0.03, 2e-6, {0, 40, 0}, 0.18e-3, 0), stretch(0.03, 0.6, 30e-6, {3, 0, 0}, 0.18e-3, 0)},
                0.3,
                roll,
                0}};
    for (Section& s : p.tubes[0].sections) s.kg_per_m = 8e-4 / 10;
    p.gravity = {-9.81, 0, 0};
    p.tip_force = {0, 1e-4, -0.5e-4};
    EXPECT_LT(distance_mm(p, 250), 0.01) << roll;
  }
}

TEST(Concentric, ALoadTurnsTheShaftOfOneWire) {
  boundary_value::Problem p;
  p.tubes = {
      {{stretch(0, 0.05, 2e-3, {0, 20, 0}, 1e-3, 0), stretch(0.05, 0.1, 2e-3, {0, 0, 0}, 1e-3, 0)}, 0.1, 0.3, 100}};
  p.tip_force = {0, 0.1, 0};
  EXPECT_LT(distance_mm(p, 100), 0.005);
  // It does turn: with a rigid shaft the shape is different.
  boundary_value::Problem rigid = p;
  rigid.tubes[0].shaft_rad_per_Nm = 0;
  EXPECT_GT((boundary_value::solve(p).curve.back() - boundary_value::solve(rigid).curve.back()).norm(), 1e-3);
}

/// Opposed tubes that are long enough are unstable when balanced: the solver must find the turned shape.
TEST(Concentric, OpposedTubesLeaveTheirUnstableBalance) {
  constexpr double k = 20, length = 1.2 * units::pi / 2 / (20 * 1.1832);  // L k sqrt(1 + nu) = 1.2 pi / 2
  ConcentricDescription d;
  d.name = "opposed";
  for (double roll : {0.0, units::pi})
    d.parts.push_back({{stretch(0, length, 1e-3, {0, k, 0}, 1e-3, 0.5e-3)}, length, roll, 0});
  d.element_lengths_m.assign(64, length / 64);
  const Concentric nest = make_concentric(d, Vector3d::Zero());
  ConcentricState state = straight_state(nest, {});
  ASSERT_TRUE(find_equilibrium(nest, {}, Vector3d::Zero(), state).converged);
  EXPECT_GT(std::fabs(state.roll_rad(0, 63) - state.roll_rad(0, 0)), 0.5);
}

/// An upright wire buckles under its weight if w L^3 / EI > 7.84 (Greenhill 1881): then the solver must find it
/// leaning.
TEST(Concentric, AnUprightWireBucklesWhenItIsTooLong) {
  for (const auto& [ratio, leans] : {std::pair{7.6, false}, std::pair{9.0, true}}) {
    boundary_value::Tube wire{{stretch(0, 0.3, 1e-5, {0, 0, 0}, 0.2e-3, 0)}, 0.3, 0, 0};
    wire.sections[0].kg_per_m = ratio * 1e-5 / (0.3 * 0.3 * 0.3) / 9.81;
    ConcentricDescription d{"wire", {{wire.sections, 0.3, 0, 0}}, std::vector<double>(200, 0.3 / 200), {}};
    const Concentric nest = make_concentric(d, {0, 0, -9.81});
    ConcentricState state = straight_state(nest, {});
    const ConcentricEquilibrium found = find_equilibrium(nest, {}, Vector3d::Zero(), state);
    ASSERT_TRUE(found.converged);
    EXPECT_EQ(found.negative_directions, 0);
    const Vector3d tip = state.carrier.rods[0].position[200];
    EXPECT_EQ(tip.head<2>().norm() > 0.02, leans) << tip.transpose();
  }
}

/// Separate rods, nested with 0.01 mm of clearance, come to rest on the same curve.
TEST(Concentric, AgreesWithTheBindingOfRods) {
  const auto outer = stretch(0, 0.15, 2e-3, {0, 8, 0}, 1.3e-3, 0.81e-3);
  const auto inner = stretch(0, 0.15, 1e-3, {0, 12, 0}, 0.8e-3, 0);
  constexpr int elements = 75;
  constexpr double roll = 1.2;
  Model model;
  for (const Section& s : {outer, inner}) {
    RodDescription d{"tube", {s}, std::vector<double>(elements, 0.15 / elements), {2, 1, 1e-3}, {}};
    model.rods.push_back(make_rod(d));
  }
  model.nestings = {{0, 1}};
  model.gravity_W.setZero();
  EndState rolled;
  rolled.q_W = turned_frame(rolled.q_W, {0, 0, roll});
  State state = make_state(model, {EndState{}, rolled});
  Scratch scratch(model);
  Inputs inputs;
  inputs.rods.resize(2);
  StepReport report;
  for (int n = 0; n < 4000; ++n) step(model, inputs, state, scratch, report);

  ConcentricDescription d{
      "nest", {{{outer}, 0.15, 0, 0}, {{inner}, 0.15, roll, 0}}, std::vector<double>(elements, 0.15 / elements), {}};
  const Concentric nest = make_concentric(d, Vector3d::Zero());
  ConcentricState together = straight_state(nest, {});
  ASSERT_TRUE(find_equilibrium(nest, {}, Vector3d::Zero(), together).converged);
  for (int rod : {0, 1})
    EXPECT_LT((state.rods[rod].position[elements] - together.carrier.rods[0].position[elements]).norm(), 0.1e-3);
}

TEST(Concentric, WhatIsNoNestIsRefused) {
  ConcentricDescription d{"nest", {}, std::vector<double>(20, 0.005), {}};
  EXPECT_THROW(make_concentric(d, Vector3d::Zero()), std::invalid_argument);
  Section s = stretch(0, 0.1, 1e-3, Vector3d::Zero(), 1e-3, 0);
  s.EI2_N_m2 *= 2;
  d.parts = {{{s}, 0.1, 0, 0}};
  EXPECT_NO_THROW(make_concentric(d, Vector3d::Zero()));
  d.parts.push_back(d.parts[0]);
  EXPECT_THROW(make_concentric(d, Vector3d::Zero()), std::invalid_argument);
  d.parts.pop_back();
  d.parts[0].shaft_rad_per_Nm = -1;
  EXPECT_THROW(make_concentric(d, Vector3d::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace ostium::core
