/// Rods that touch each other or themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/model/state.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/step/step.h"
#include "tests/support/allocations.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

constexpr double radius_m = 0.45e-3, EI_N_m2 = 60e9 * units::pi / 4 * radius_m * radius_m * radius_m * radius_m;

RodDescription wire(double length_m, int elements) {
  RodDescription d = steel_wire({.elements = elements, .length_m = length_m, .gravity = false});
  d.damping.drag_across_N_s_m2 = d.damping.drag_along_N_s_m2 = 0.3;
  return d;
}

/// Distance of two segments by search, sharing no code with contact.
double apart(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  double least = 1;
  for (int i = 0; i <= 8; ++i) {
    const Vector3d p = a + i / 8.0 * (b - a), v = d - c;
    const double t = std::clamp((p - c).dot(v) / v.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - c - t * v).norm());
  }
  return least;
}

/// Two cantilevers of 0.2 m that cross in the middle; the upper one's tip is pressed down.
struct Crossed {
  static constexpr double length_m = 0.2, middle_m = 0.1;

  explicit Crossed(bool touch) : model(model_of(touch)), state(make_state(model, bases())), scratch(model) {
    inputs.rods.resize(2);
    inputs.rods[1].tip_force_W_N = Vector3d(0, 0, -press_N);
  }
  static Model model_of(bool touch) {
    Model m;
    m.rods = {make_rod(wire(length_m, 101)), make_rod(wire(length_m, 90))};
    m.gravity_W.setZero();
    m.rods_touch = touch;
    return m;
  }
  static std::vector<EndState> bases() {
    EndState lower = along_x(), upper = along_x();
    upper.q_W = turned_frame(upper.q_W, Vector3d(0, 0, units::pi / 2));
    upper.p_W = Vector3d(middle_m, -middle_m, gap_m + 2 * radius_m);
    return {lower, upper};
  }
  void run(int ms) {
    for (int n = 0; n < ms; ++n) step(model, inputs, state, scratch, report);
  }
  /// Height of the upper rod's surface above the lower one's at the crossing.
  double between_m() const {
    double least = 1;
    for (int i = 0; i < 101; ++i)
      for (int j = 0; j < 90; ++j) {
        const auto& p = state.rods[0].position;
        const auto& q = state.rods[1].position;
        least = std::min(least, apart(p[i], p[i + 1], q[j], q[j + 1]));
      }
    return least - 2 * radius_m;
  }

  static constexpr double press_N = 0.01, gap_m = 0.2e-3;
  Model model;
  State state;
  Scratch scratch;
  Inputs inputs;
  StepReport report;
};

/// Euler-Bernoulli: the force Q between them follows from equal deflections in the middle, less the gap.
TEST(Rods, CrossedCantileversShareALoad) {
  Crossed crossed(true);
  crossed.run(2000);
  const double c3 = std::pow(Crossed::middle_m, 3);
  const double Q =
      (Crossed::press_N * Crossed::middle_m * Crossed::middle_m * (3 * Crossed::length_m - Crossed::middle_m) / 6 -
       EI_N_m2 * Crossed::gap_m) /
      (2 * c3 / 3);
  double push = 0;
  for (const RodTouch& touch : crossed.report.rod_touches) push += touch.force_W_N.norm();
  EXPECT_NEAR(push, Q, 0.01 * Q);
  EXPECT_NEAR(crossed.between_m(), 0, 5e-6);
  EXPECT_EQ(crossed.report.trouble, 0u);
  const RodTouch& touch = crossed.report.rod_touches.front();
  EXPECT_LT(touch.force_W_N.z() * (touch.rod == 0 ? 1 : -1), 0) << "the lower one is pressed down";

  // A new scratch continues bit-identically, and nothing is allocated.
  State other = crossed.state;
  Scratch fresh(crossed.model);
  crossed.run(20);
  const long before = allocations();
  for (int n = 0; n < 20; ++n) step(crossed.model, crossed.inputs, other, fresh, crossed.report);
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_EQ(first_difference(crossed.state, other), "");
}

TEST(Rods, WithoutContactTheyPassThroughEachOther) {
  Crossed crossed(false);
  crossed.run(2000);
  EXPECT_GT(crossed.state.rods[0].position[50].z() - crossed.state.rods[1].position[45].z(), 2 * radius_m);
  EXPECT_TRUE(crossed.report.rod_touches.empty());
}

/// A wire bent into a loop, its end above and across its beginning, is pressed down by twice its height.
double nearest_of_own(bool touch, double* push_N) {
  Bench bench = bench_of(wire(0.3, 150), false);
  Model model = bench.model;
  model.rods_touch = touch;
  State state = make_state(model, {along_x()});
  Scratch scratch(model);
  Inputs inputs = bench.inputs;
  StepReport report;
  RodInputs& in = inputs.rods[0];
  in.tip.hold = Hold::clamped;
  double least = 1;
  *push_N = 0;
  const auto run = [&](int ms) {
    for (int n = 0; n < ms; ++n) {
      step(model, inputs, state, scratch, report);
      for (const RodTouch& t : report.rod_touches) *push_N = std::max(*push_N, t.force_W_N.norm());
      if (n % 10 != 9) continue;
      const auto& p = state.rods[0].position;
      for (int i = 0; i < 150; ++i)
        for (int j = i + 8; j < 150; ++j)
          if ((p[i] - p[j]).norm() < 8e-3) least = std::min(least, apart(p[i], p[i + 1], p[j], p[j + 1]));
    }
  };
  in.tip.velocity_W_m_s = Vector3d(-0.25, 0.04, 0.02);
  in.tip.turn_rate_W_rad_s = Vector3d(0, 0, -1.5 * units::pi);
  run(1000);
  in.tip.velocity_W_m_s = Vector3d(0, 0, -0.05);
  in.tip.turn_rate_W_rad_s.setZero();
  run(800);
  return least;
}

TEST(Rods, ALoopDoesNotPassThroughItself) {
  double push_N;
  EXPECT_LT(nearest_of_own(false, &push_N), 1.5 * radius_m);
  EXPECT_GT(nearest_of_own(true, &push_N), 2 * radius_m - 0.02e-3);
  EXPECT_GT(push_N, 0);
}

}  // namespace
}  // namespace ostium::core
