/// Rods side by side in one lumen: a chain that forks is the same mechanics as one that does not.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "core/base/units.h"
#include "core/contact/penetration_oracle.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"
#include "core/step/step.h"
#include "tests/core/plain_rod.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

RodDescription guide() { return hooked(plain_rod(0.25, 1.5e-3, 1.2e-3, 0.9e-3, 125), {0, 20, 0}); }
RodDescription shaft(double curve_per_m = 0) {
  return hooked(plain_rod(0.35, 3e-4, 0.42e-3, 0.25e-3, 150), {curve_per_m, 0, 0});
}
RodDescription wire(double curve_per_m = 0) {
  return hooked(plain_rod(0.4, 1e-4, 0.18e-3, 0, 180), {0, curve_per_m, 0});
}

struct Insertion {
  explicit Insertion(Model m, std::vector<double> inserted_m) : model(std::move(m)), scratch(model) {
    state = make_state(model, std::vector<EndState>(model.rods.size(), along_x()), inserted_m);
    inputs.rods.resize(model.rods.size());
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      drive(static_cast<int>(state.step), inputs);
      step(model, inputs, state, scratch, report);
      trouble |= report.trouble;
    }
  }
  Vector3d tip(std::size_t r) const { return state.rods[r].position[model.rods[r].elements]; }

  std::function<void(int, Inputs&)> drive = [](int, Inputs&) {};
  Model model;
  State state;
  Scratch scratch;
  Inputs inputs;
  StepReport report;
  unsigned trouble = 0;
};

/// Largest distance between the nodes of the same rod in two runs, m.
double apart_m(const Insertion& a, const Insertion& b, std::size_t r, std::size_t of_b) {
  double most = 0;
  for (int i = a.state.rods[r].first; i < a.model.rods[r].nodes(); ++i)
    most = std::max(most, (a.state.rods[r].position[i] - b.state.rods[of_b].position[i]).norm());
  return most;
}

void push_and_turn(int at, Inputs& inputs) {
  const double t = 1e-3 * at;
  inputs.rods[0].feed_m_s = 0.01 * std::sin(9 * t);
  for (std::size_t r = 1; r < inputs.rods.size(); ++r) {
    inputs.rods[r].feed_m_s = 0.03 * std::sin((3 + static_cast<double>(r)) * t);
    inputs.rods[r].base.turn_rate_W_rad_s = Vector3d(2.0 * static_cast<double>(r), 0, 0);
  }
}

/// The largest difference of what the hands feel, relative to the largest force or torque.
struct Felt {
  double push_N = 0, torque_Nm = 0, push_apart_N = 0, torque_apart_Nm = 0;

  void take(const RodReport& a, const RodReport& b) {
    push_N = std::max(push_N, std::fabs(a.push_N)), torque_Nm = std::max(torque_Nm, std::fabs(a.torque_Nm));
    push_apart_N = std::max(push_apart_N, std::fabs(a.push_N - b.push_N));
    torque_apart_Nm = std::max(torque_apart_Nm, std::fabs(a.torque_Nm - b.torque_Nm));
  }
};

// A chain that is cut where a rod leaves, and joined again there, is the chain that was not cut. Where one rod goes on
// in another across the cut, its twist is interpolated on either side of it alone.
TEST(SideBySide, AForkWithOneBranchIsTheChainItself) {
  struct Case {
    bool with_shaft;
    double apart_m, felt;
  };
  for (const auto& [with_shaft, most_apart_m, most_felt] : {Case{false, 30e-6, 5e-3}, Case{true, 0.6e-3, 0.15}}) {
    Model one;
    one.rods.push_back(make_rod(guide()));
    if (with_shaft) one.rods.push_back(make_rod(shaft(10)));
    one.rods.push_back(make_rod(wire(25)));
    one.nestings = coaxial(with_shaft ? std::vector{0, 1, 2} : std::vector{0, 1});
    for (Nesting& n : one.nestings) n.friction = 0.1;
    Model cut = one;
    cut.fork_from = 1;
    const std::vector<double> inserted_m = with_shaft ? std::vector{0.2, 0.26, 0.3} : std::vector{0.2, 0.3};
    Insertion whole(one, inserted_m), forked(cut, inserted_m);
    whole.drive = forked.drive = push_and_turn;
    Felt felt;
    for (int i = 0; i < 400; ++i) {
      whole.steps(1), forked.steps(1);
      for (std::size_t r = 0; r < one.rods.size(); ++r) {
        ASSERT_LT(apart_m(whole, forked, r, r), most_apart_m) << "rod " << r << " of " << one.rods.size() << ", " << i;
        felt.take(whole.report.rods[r], forked.report.rods[r]);
      }
    }
    EXPECT_LT(felt.push_apart_N, most_felt * felt.push_N);
    EXPECT_LT(felt.torque_apart_Nm, most_felt * felt.torque_Nm);
    EXPECT_EQ(whole.trouble, 0u);
    EXPECT_EQ(forked.trouble, 0u);
    EXPECT_EQ(forked.scratch.strands.size(), 2u);
  }
}

Model guide_and_two_wires(const Vector3d& first_per_m, const Vector3d& second_per_m) {
  Model model;
  model.rods = {make_rod(guide()), make_rod(hooked(plain_rod(0.4, 1e-4, 0.18e-3, 0, 180), first_per_m)),
                make_rod(hooked(plain_rod(0.4, 1e-4, 0.18e-3, 0, 180), second_per_m))};
  model.nestings = {{.outer = 0, .inner = 1, .friction = 0.1}, {.outer = 0, .inner = 2, .friction = 0.1}};
  return model;
}

Model in_honey(Model model) {
  for (Rod& rod : model.rods) rod.damping.drag_across_N_s_m2 = rod.damping.drag_along_N_s_m2 = 1;
  return model;
}

// Neither wire comes first: named the other way round, both go the same ways.
TEST(SideBySide, WiresMayBeExchanged) {
  const Vector3d left(30, 0, 0), right(-10, 15, 0);
  Insertion a(guide_and_two_wires(left, right), {0.2, 0.27, 0.3}),
      b(guide_and_two_wires(right, left), {0.2, 0.3, 0.27});
  a.drive = [](int at, Inputs& inputs) { push_and_turn(at, inputs); };
  b.drive = [](int at, Inputs& inputs) {
    push_and_turn(at, inputs);
    std::swap(inputs.rods[1], inputs.rods[2]);
  };
  for (int i = 0; i < 400; ++i) {
    a.steps(1), b.steps(1);
    for (const auto& [r, s] : {std::pair{0, 0}, {1, 2}, {2, 1}}) {
      ASSERT_LT(apart_m(a, b, r, s), 1e-6) << i << ", rod " << r;
      ASSERT_NEAR(a.report.rods[r].push_N, b.report.rods[s].push_N, 1e-3) << i << ", rod " << r;
    }
  }
  EXPECT_EQ(a.trouble, 0u);
  EXPECT_EQ(a.scratch.strands.size(), 3u);
}

// Held up by the hands alone: they bear the weight of all three, whichever way they bend.
TEST(SideBySide, TheHandsBearTheWeight) {
  Insertion run(in_honey(guide_and_two_wires({30, 0, 0}, {-10, 15, 0})), {0.2, 0.27, 0.3});
  run.steps(6000);
  const double weight_N = 9.81 * 4e-3 * (0.2 + 0.27 + 0.3);
  Vector3d held_N = Vector3d::Zero();
  for (const RodReport& rod : run.report.rods) held_N += rod.base_force_W_N;
  EXPECT_LT((held_N - Vector3d(0, 0, weight_N)).norm(), 0.01 * weight_N);
}

// Steps of a fork are the same to the bit whatever the scratch held.
TEST(SideBySide, ScratchIsDisposable) {
  const Model model = guide_and_two_wires({30, 0, 0}, {-10, 15, 0});
  Insertion kept(model, {0.2, 0.19, 0.25}), renewed(model, {0.2, 0.19, 0.25});
  kept.drive = renewed.drive = push_and_turn;
  for (int i = 0; i < 300; ++i) {
    kept.steps(1);
    renewed.scratch = Scratch(renewed.model);
    renewed.steps(1);
    ASSERT_EQ(first_difference(kept.state, renewed.state), "") << i;
  }
}

// The second wire leaves and returns, many times: forking moves nothing and startles nobody.
TEST(SideBySide, AWireThatComesAndGoesMovesNothing) {
  Insertion run(in_honey(guide_and_two_wires({0, 0, 0}, {0, 0, 0})), {0.2, 0.3, 0.19});
  run.steps(6000);
  double before_N = run.report.rods[1].push_N;
  run.drive = [](int at, Inputs& inputs) { inputs.rods[2].feed_m_s = 0.05 * std::cos(units::pi * 1e-3 * at); };
  int forked = 0;
  double moved = 0, jumped = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d tip = run.tip(1);
    run.steps(1);
    forked += run.scratch.strands.size() > 1 ? 1 : 0;
    moved = std::max(moved, (run.tip(1) - tip).norm());
    jumped = std::max(jumped, std::fabs(run.report.rods[1].push_N - before_N));
    before_N = run.report.rods[1].push_N;
  }
  EXPECT_EQ(run.trouble, 0u);
  EXPECT_LT(moved, 20e-6);
  EXPECT_LT(jumped, 0.02);
  EXPECT_GT(forked, 1000);
  EXPECT_LT(forked, 3000);
}

/// A bent tube of 3 mm radius, from 50 mm before the introducer; the rods begin on its axis.
SurfaceDescription bent_tube() {
  std::vector<TubePoint> points = bend(60e-3, units::pi / 2, 0.2, 0.2, 3e-3, 4e-3);
  for (TubePoint& point : points) point.p_W.x() -= 0.05;
  return tube(points, 32);
}

Model in_bend(Model model, const SurfaceDescription& wall, double friction) {
  Surface surface = make_surface(wall);
  surface.friction = friction;
  model.surfaces = {std::make_shared<Surface>(std::move(surface))};
  return model;
}

// Walls act on a branch as on the chain itself.
TEST(SideBySide, AForkWithOneBranchMeetsWallsAsTheChainItself) {
  Model one;
  one.rods = {make_rod(guide()), make_rod(wire(25))};
  one.nestings = coaxial({0, 1});
  const SurfaceDescription wall = bent_tube();
  one = in_bend(one, wall, 0.05);
  Model cut = one;
  cut.fork_from = 1;
  Insertion whole(one, {0.12, 0.14}), forked(cut, {0.12, 0.14});
  whole.drive = forked.drive = [](int at, Inputs& inputs) {
    inputs.rods[0].feed_m_s = at < 1000 ? 0.05 : 0;
    inputs.rods[1].feed_m_s = at < 1500 ? 0.12 : 0;
  };
  Felt felt;
  double touched_N = 0, late = 0;
  for (int i = 0; i < 2500; ++i) {
    whole.steps(1), forked.steps(1);
    for (std::size_t r = 0; r < 2; ++r) {
      if (i < 2000) continue;  // on the way, a beat of contact earlier or later throws them apart
      felt.take(whole.report.rods[r], forked.report.rods[r]);
      late = std::max(late, apart_m(whole, forked, r, r));
    }
    for (const Touch& touch : forked.report.touches) touched_N = std::max(touched_N, touch.normal_W_N.norm());
  }
  EXPECT_LT(late, 0.1e-3);
  EXPECT_GT(touched_N, 0.01);
  EXPECT_LT(felt.push_apart_N, 0.05 * felt.push_N);
}

// Three instruments, each in a hand of its own that does not care: nothing leaves, nothing breaks, and the steps are
// the same to the bit.
TEST(SideBySide, RandomHandsStayInside) {
  const SurfaceDescription wall = bent_tube();
  const Model model = in_bend(guide_and_two_wires({30, 0, 0}, {-10, 40, 0}), wall, 0.05);
  Insertion run(model, {0.1, 0.12, 0.14}), twin(model, {0.1, 0.12, 0.14});
  std::mt19937 random(7);
  std::uniform_real_distribution<> even(-1, 1);
  std::vector<double> feed(3), turn(3);
  const auto drive = [&](int, Inputs& inputs) {
    for (std::size_t r = 0; r < 3; ++r) {
      inputs.rods[r].feed_m_s = feed[r];
      inputs.rods[r].base.turn_rate_W_rad_s = Vector3d(turn[r], 0, 0);
    }
  };
  run.drive = twin.drive = drive;
  PenetrationOracle oracle(wall);
  oracle.set_frame(0);
  double deepest_m = 0;
  int forked = 0, halved = 0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 250 == 0)
      for (std::size_t r = 0; r < 3; ++r) {
        const double inserted_m = run.state.rods[r].inserted_m, most_m = r == 0 ? 0.2 : 0.36;
        feed[r] = inserted_m < 0.1 ? 0.1 : inserted_m > most_m ? -0.1 : 0.15 * even(random);
        turn[r] = 12 * even(random);
      }
    run.steps(1), twin.steps(1);
    ASSERT_EQ(first_difference(run.state, twin.state), "") << i;
    deepest_m = std::max(deepest_m, run.report.deepest_m);
    forked += run.scratch.strands.size() > 1, halved += run.report.counts.halvings;
    if (i % 50 > 0) continue;
    for (std::size_t r = 0; r < 3; ++r)
      for (int n = run.state.rods[r].exposed + 1; n < model.rods[r].nodes(); ++n)
        ASSERT_GT(oracle.winding(run.state.rods[r].position[n]), 0.5) << "rod " << r << ", node " << n << ", " << i;
  }
  EXPECT_LT(deepest_m, 50e-6);
  EXPECT_GT(forked, 1000);
}

}  // namespace
}  // namespace ostium::core
