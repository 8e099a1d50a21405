/// Nested rods: bit-level promises, and balances of forces and moments.
#include "core/model/nesting.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/rod/introducer.h"
#include "core/samples/steel_wire.h"
#include "core/step/step.h"
#include "tests/core/plain_rod.h"
#include "tests/support/allocations.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

/// A catheter that is curved at its tip, and a wire in it that protrudes.
Model catheter_and_wire() {
  RodDescription catheter = plain_rod(0.25, 1.5e-3, 0.9e-3, 0.6e-3, 125);
  Section tip = catheter.sections[0];
  tip.to_tip_m = 0.04, tip.rest_curvature_per_m = {0, 20, 0};
  catheter.sections[0].from_tip_m = 0.04;
  catheter.sections.insert(catheter.sections.begin(), tip);
  Model model;
  model.rods = {make_rod(catheter), make_rod(plain_rod(0.35, 1e-3, 0.45e-3, 0, 150))};
  model.nestings = coaxial({0, 1});
  return model;
}

State at_start(const Model& model) { return make_state(model, {along_x(), along_x()}, {0.24, 0.3}); }

Inputs hand(int step) {
  Inputs inputs;
  inputs.rods.resize(2);
  const double t = 1e-3 * step;
  inputs.rods[0].feed_m_s = 0.02 * std::sin(9 * t);
  inputs.rods[1].feed_m_s = 0.05 * std::sin(5 * t);
  inputs.rods[1].base.turn_rate_W_rad_s = Vector3d(6, 0, 0);
  return inputs;
}

TEST(Nesting, ANestThatCannotBeIsRefused) {
  const auto refused = [](const std::vector<Nesting>& nestings, const char* why) {
    Model model = catheter_and_wire();
    model.nestings = nestings;
    try {
      check(model);
      ADD_FAILURE() << "not refused: " << why;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused({{.outer = 1, .inner = 0}}, "outer one must come before");
  refused({{.outer = 0, .inner = 2}}, "there are 2 rods");
  refused({{.outer = 0, .inner = 1, .lumen_m = 0}}, "lumen must be longer");

  // Five nested rods are too many; a wire with four alternatives around it in the outermost rod is not.
  Model tubes;
  for (int k = 0; k < 4; ++k)
    tubes.rods.push_back(make_rod(plain_rod(0.35, 1e-3, (4 - k) * 1e-3, (3.8 - k) * 1e-3, 150)));
  tubes.rods.push_back(make_rod(plain_rod(0.35, 1e-3, 0.2e-3, 0, 150)));
  tubes.nestings = coaxial({0, 1, 2, 3, 4});
  EXPECT_THROW(check(tubes), std::invalid_argument);
  tubes.nestings.clear();
  for (int k = 1; k < 4; ++k) tubes.nestings.push_back({.outer = 0, .inner = k});
  for (int k = 0; k < 4; ++k) tubes.nestings.push_back({.outer = k, .inner = 4});
  EXPECT_NO_THROW(check(tubes));

  Model thick = catheter_and_wire();
  thick.rods[1] = make_rod(plain_rod(0.35, 1e-3, 0.65e-3, 0, 150));
  EXPECT_THROW(check(thick), std::invalid_argument);
}

TEST(Nesting, AStepDoesNotDependOnWhatScratchHeld) {
  const Model model = catheter_and_wire();
  State kept = at_start(model), fresh = at_start(model);
  Scratch scratch(model);
  StepReport report;
  for (int n = 0; n < 200; ++n) {
    step(model, hand(n), kept, scratch, report);
    Scratch other(model);
    step(model, hand(n), fresh, other, report);
    ASSERT_EQ(first_difference(kept, fresh), "") << n;
  }
}

// A wire that once protruded and now ends inside the catheter keeps nothing of that.
TEST(Nesting, NorDoesItWhereARodEndsInsideAnother) {
  const Model model = catheter_and_wire();
  State kept = at_start(model), fresh = at_start(model);
  Scratch scratch(model);
  StepReport report;
  for (int n = 0; n < 600; ++n) {
    Inputs inputs = hand(0);
    inputs.rods[0].feed_m_s = 0, inputs.rods[1].feed_m_s = n < 100 ? 0.05 : -0.2;
    step(model, inputs, kept, scratch, report);
    Scratch other(model);
    step(model, inputs, fresh, other, report);
    ASSERT_EQ(first_difference(kept, fresh), "") << n;
  }
  EXPECT_LT(kept.rods[1].inserted_m, kept.rods[0].inserted_m - 5e-3) << "it is inside now";
}

TEST(Nesting, ASavedStateGoesOnBitIdentically) {
  const Model model = catheter_and_wire();
  State a = at_start(model);
  Scratch scratch(model);
  StepReport report;
  for (int n = 0; n < 150; ++n) step(model, hand(n), a, scratch, report);
  State b = at_start(model);
  restore(save(a), b);
  for (int n = 150; n < 300; ++n) {
    step(model, hand(n), a, scratch, report);
    step(model, hand(n), b, scratch, report);
  }
  EXPECT_EQ(first_difference(a, b), "");
  EXPECT_EQ(hash(a), hash(b));
}

TEST(Nesting, AStepDoesNotAllocate) {
  const Model model = catheter_and_wire();
  State state = at_start(model);
  Scratch scratch(model);
  StepReport report;
  const std::vector<Inputs> inputs = {hand(100), hand(500), hand(900)};
  step(model, inputs[0], state, scratch, report);
  const long before = allocations();
  for (int n = 0; n < 300; ++n) step(model, inputs[n / 100], state, scratch, report);
  EXPECT_EQ(allocations() - before, 0);
}

// Action equals reaction between the rods: the introducer carries the weight of both, and no more.
TEST(Nesting, AtRestTheBasesBearTheWeightOfBoth) {
  Model model = catheter_and_wire();
  for (Rod& r : model.rods) r.damping = {1, 0.5, 2e-3};
  State state = make_state(model, {along_x(), along_x()});
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(2);
  for (int n = 0; n < 6000; ++n) step(model, inputs, state, scratch, report);
  const double weight = 9.81 * (model.rods[0].total_mass_kg + model.rods[1].total_mass_kg);
  const Vector3d borne = report.rods[0].base_force_W_N + report.rods[1].base_force_W_N;
  EXPECT_NEAR(borne.z() / weight, 1, 0.005);
  EXPECT_NEAR(borne.x() / weight, 0, 0.005);
  EXPECT_GT(state.rods[1].contact_force[100].norm(), 0);
}

// Four rods share one centreline: stiffness is their sum, curvature their stiffness-weighted mean.
TEST(Nesting, FourRodsBendAsOne) {
  const double EI[] = {4e-3, 2e-3, 1e-3, 5e-4}, k[] = {5, 0, 20, -10}, radius[] = {1.6e-3, 1.2e-3, 0.8e-3, 0.4e-3};
  Model model;
  double stiffness = 0, moment = 0;
  for (int i = 0; i < 4; ++i) {
    RodDescription d = plain_rod(0.2 + 0.01 * i, EI[i], radius[i], i < 3 ? radius[i] - 0.3e-3 : 0, 100);
    d.sections[0].rest_curvature_per_m = {0, k[i], 0};
    d.damping = {1, 0.5, 1e-3};
    model.rods.push_back(make_rod(d));
    stiffness += EI[i], moment += EI[i] * k[i];
  }
  model.nestings = coaxial({0, 1, 2, 3});
  model.gravity_W.setZero();
  State state = make_state(model, std::vector<EndState>(4, along_x()));
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(4);
  for (int n = 0; n < 3000; ++n) {
    step(model, inputs, state, scratch, report);
    ASSERT_EQ(report.trouble, 0u) << n;
  }
  for (int r = 0; r < 4; ++r) {
    const auto frame = [&](int j) {
      const Eigen::Vector4d q = state.rods[r].orientation[j];
      return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    };
    const double length = model.rods[r].node_from_tip_m[40] - model.rods[r].node_from_tip_m[60];
    EXPECT_NEAR(frame(40).angularDistance(frame(60)) / length / (moment / stiffness), 1, 0.005) << r;
  }
}

// Two rods of three lie aside of the one that they leave: each is moved to where it leaves, and the first one stays.
TEST(Nesting, PartsThatAreTornAreAllMovedToWhereTheyLeave) {
  Model model;
  const double radius[] = {1.6e-3, 1.2e-3, 0.8e-3};
  for (int i = 0; i < 3; ++i)
    model.rods.push_back(make_rod(plain_rod(0.2 + 0.04 * i, 1e-3, radius[i], i < 2 ? radius[i] - 0.3e-3 : 0, 100)));
  model.nestings = coaxial({0, 1, 2});
  model.gravity_W.setZero();
  std::vector<EndState> bases(3, along_x());
  for (int i = 0; i < 3; ++i) bases[i].p_W.y() = 0.02 * i;
  State state = make_state(model, bases, {0.2, 0.24, 0.28});
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(3);
  step(model, inputs, state, scratch, report);
  for (int r = 0; r < 3; ++r) {
    const Vector3d tip = state.rods[r].position[100];
    EXPECT_NEAR(tip.y(), 0, 1e-6) << r;
    EXPECT_NEAR(tip.x(), 0.2 + 0.04 * r, 1e-5) << r;
  }
}

// A straight catheter pulled back over a held wire, without friction, does not move the wire.
TEST(Nesting, ACatheterIsDrawnBackOverAHeldWire) {
  Model model;
  model.rods = {make_rod(plain_rod(0.25, 1.5e-3, 0.9e-3, 0.6e-3, 125)),
                make_rod(plain_rod(0.35, 1e-3, 0.45e-3, 0, 150))};
  model.nestings = coaxial({0, 1});
  model.gravity_W.setZero();
  State state = make_state(model, {along_x(), along_x()});
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(2);
  inputs.rods[0].feed_m_s = -0.05;
  const Vector3d tip = state.rods[1].position[150];
  for (int n = 0; n < 4000; ++n) step(model, inputs, state, scratch, report);
  EXPECT_LT(state.rods[0].inserted_m, 0.051);
  EXPECT_LT((state.rods[1].position[150] - tip).norm(), 0.5e-3);
}

// A soft wire in a hardly yielding catheter with a right-angle bend: capstan friction (Euler, Eytelwein).
TEST(Nesting, FrictionInABentCatheterIsThatOfARopeOnADrum) {
  constexpr double friction = 0.2, tension = 1, angle = units::pi / 2, length = 0.2, radius = 0.45e-3;
  const auto bent = [&](RodDescription d) {
    for (Section& s : d.sections) s.rest_curvature_per_m = {0, angle / length, 0};
    return make_rod(d);
  };
  const RodDescription wire = plain_rod(length + 0.05, 2e-5, radius, 0, 250);
  Model model;
  model.rods = {bent(plain_rod(length, 1, 1.2e-3, 0.5e-3, 200)), bent(wire)};
  model.nestings = {{.outer = 0, .inner = 1, .friction = friction}};
  model.gravity_W.setZero();
  for (Rod& r : model.rods) r.damping = {1, 0.5, 1e-3};
  State state = make_state_at_rest_shape(model, {along_x(), along_x()});
  model.rods[1] = make_rod(wire);  // forced into the bent catheter, but straight at rest
  model.rods[1].damping = model.rods[0].damping;
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(2);
  double load = 0;
  const auto run = [&](int steps) {
    for (int n = 0; n < steps; ++n) {
      load = std::min(tension, load + 0.01);
      inputs.rods[1].tip_force_W_N = Vector3d(0, 0, -load);
      step(model, inputs, state, scratch, report);
      ASSERT_EQ(report.trouble, 0u) << n;
    }
  };
  const auto pull = [&] { return -report.rods[1].push_N / tension; };
  run(1000);
  inputs.rods[1].feed_m_s = -0.01;
  run(1000);
  EXPECT_NEAR(pull(), std::exp(friction * angle), 0.03);
  const double other_hand = report.rods[0].push_N;  // the catheter pushes back what the wire bears in addition
  EXPECT_NEAR(other_hand / tension, std::exp(friction * angle), 0.03);
  inputs.rods[1].feed_m_s = 0;
  run(500);
  EXPECT_NEAR(pull(), std::exp(friction * angle), 0.03) << "it sticks";
  inputs.rods[1].feed_m_s = 0.01;
  run(1000);
  EXPECT_NEAR(pull(), std::exp(-friction * angle), 0.03);
  inputs.rods[1].feed_m_s = 0;
  inputs.rods[1].base.turn_rate_W_rad_s = Vector3d(1, 0, 0);
  run(2500);
  EXPECT_NEAR(pull(), 1, 0.01) << "turning, it does not resist a pull";
  const double torque = friction * radius * tension * angle;
  EXPECT_NEAR(report.rods[1].torque_Nm / torque, 1, 0.04);
  EXPECT_NEAR(-report.rods[0].torque_Nm / torque, 1, 0.05);
  inputs.rods[1].base.turn_rate_W_rad_s.setZero();
  run(500);
  EXPECT_NEAR(report.rods[1].torque_Nm / torque, 1, 0.04) << "it holds the torque";
}

// One catheter is pulled out over a held wire with a bent tip, and another is pushed in over it.
TEST(Nesting, ACatheterIsExchangedOverAHeldWire) {
  Model model;
  RodDescription wire = plain_rod(0.35, 1e-3, 0.45e-3, 0, 175);
  Section tip = wire.sections[0];
  tip.to_tip_m = wire.sections[0].from_tip_m = 0.05;
  tip.rest_curvature_per_m = {0, 30, 0};
  wire.sections.insert(wire.sections.begin(), tip);
  model.rods = {make_rod(plain_rod(0.25, 1.5e-3, 0.9e-3, 0.6e-3, 125)),
                make_rod(plain_rod(0.2, 3e-3, 1e-3, 0.7e-3, 100)), make_rod(wire)};
  model.nestings = {{0, 2}, {1, 2}};
  model.gravity_W.setZero();
  State state = make_state_at_rest_shape(model, {along_x(), along_x(), along_x()}, {0.15, 0, 0.25});
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(3);
  const Vector3d p = state.rods[2].position[175];
  double moved = 0;
  const auto fed = [&](int catheter, double feed_m_s, int steps) {
    inputs.rods[catheter].feed_m_s = feed_m_s;
    for (int n = 0; n < steps; ++n) {
      step(model, inputs, state, scratch, report);
      EXPECT_EQ(report.trouble, 0u) << n;
      moved = std::max(moved, (state.rods[2].position[175] - p).norm());
    }
    inputs.rods[catheter].feed_m_s = 0;
  };
  fed(0, -0.05, 2980);
  EXPECT_FALSE(in_body(model.rods[0], state.rods[0]));
  fed(1, 0.05, 3000);
  EXPECT_NEAR(state.rods[1].inserted_m, 0.15, 1e-9);
  EXPECT_LT(moved, 0.5e-3);
  EXPECT_EQ(scratch.lead[2], 1);
}

// Here a rapid-exchange shaft holds the wire over its last 10 cm; behind that, both run side by side in the guide.
TEST(Nesting, ARapidExchangeShaftRidesOnTheWireOverItsLastStretch) {
  Model model;
  model.rods = {make_rod(plain_rod(0.5, 1e-3, 1e-3, 0.9e-3, 250)),
                make_rod(plain_rod(0.55, 1e-4, 0.45e-3, 0.2e-3, 275)),
                make_rod(plain_rod(0.6, 4e-5, 0.178e-3, 0, 300))};
  model.nestings = {{0, 1}, {0, 2}, {.outer = 1, .inner = 2, .lumen_m = 0.1}};
  model.gravity_W.setZero();
  State state = make_state(model, {along_x(), along_x(), along_x()}, {0.45, 0.40, 0.42});
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(3);
  for (int n = 0; n < 1000; ++n) {
    inputs.rods[1].feed_m_s = 0.03 * std::sin(2e-3 * n);
    inputs.rods[2].feed_m_s = 0.05 * std::sin(1.5e-3 * n);
    inputs.rods[2].base.turn_rate_W_rad_s = Vector3d(5, 0, 0);
    step(model, inputs, state, scratch, report);
    ASSERT_EQ(report.trouble, 0u) << n;
  }
  const Nest& nest = scratch.nests[0];
  const Layer& layer = nest.layers[2];
  const double shaft_tip = state.rods[1].inserted_m;
  for (int e = 0; e < layer.covered; ++e) {
    const double depth = nest.depth.at(0)[e];
    const double near_an_end = std::min(std::fabs(depth - shaft_tip), std::fabs(depth - shaft_tip + 0.1));
    if (near_an_end < 0.005) continue;
    ASSERT_EQ(layer.host[e], depth > shaft_tip - 0.1 && depth < shaft_tip ? 1 : 0) << depth;
    EXPECT_NEAR(layer.room.at(0)[e], layer.host[e] == 1 ? 0.2e-3 - 0.178e-3 : 0.9e-3 - 0.178e-3, 1e-9);
  }
  for (int i = state.rods[2].first; i < model.rods[2].nodes(); ++i)
    EXPECT_LT(state.rods[2].offset[i].norm(), 0.9e-3 - 0.178e-3) << i;
}

}  // namespace
}  // namespace ostium::core
