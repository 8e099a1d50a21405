/// Properties of the step regardless of physics: it is a pure function of model, inputs and state.
#include "core/step/step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "tests/support/allocations.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

/// Three different rods, so that full, half-filled and single lanes are all used.
Model three_rods() {
  Model model;
  RodDescription damped = steel_wire({.elements = 61, .E_Pa = 5e9, .length_m = 0.4});
  damped.damping = {0.007, 0.0035, 1e-3};
  RodDescription curved = steel_wire({.elements = 33, .E_Pa = 20e9, .length_m = 0.2});
  curved.sections[0].rest_curvature_per_m = Vector3d(3, -5, 2);
  for (const RodDescription& d : {steel_wire({.elements = 100}), damped, curved}) model.rods.push_back(make_rod(d));
  return model;
}

State straight(const Model& model) { return make_state(model, std::vector<EndState>(model.rods.size(), along_x())); }

/// Inputs that change all the time: push, turn, release and hold again.
Inputs busy_inputs(const Model& model, int step) {
  Inputs inputs;
  inputs.rods.resize(model.rods.size());
  for (std::size_t r = 0; r < inputs.rods.size(); ++r) {
    RodInputs& in = inputs.rods[r];
    const double t = 1e-3 * step, phase = 10 * t + static_cast<double>(r);
    in.base.velocity_W_m_s = Vector3d(0.1 * std::sin(phase), 0.05 * std::cos(3 * phase), 0);
    in.base.turn_rate_W_rad_s = Vector3d(20 * std::sin(2 * phase), 1, 0);
    in.tip_force_W_N = Vector3d(0, 0.01 * std::sin(phase), 0);
    in.feed_m_s = -0.1 * std::cos(4 * phase);
    if (step % 100 > 50) in.tip.hold = r == 0 ? Hold::clamped : r == 1 ? Hold::pinned : Hold::guided;
  }
  return inputs;
}

void run(const Model& model, int from, int to, State& state, Scratch& scratch) {
  StepReport report;
  for (int i = from; i < to; ++i) step(model, busy_inputs(model, i), state, scratch, report);
}

TEST(Step, SameInputsGiveTheSameBits) {
  const Model model = three_rods();
  State a = straight(model), b = straight(model);
  Scratch scratch_a(model), scratch_b(model);
  run(model, 0, 300, a, scratch_a);
  run(model, 0, 300, b, scratch_b);
  EXPECT_EQ(first_difference(a, b), "");
  EXPECT_EQ(hash(a), hash(b));
}

// A load on a stretch that contains only the tip's node equals a tip load; on a longer stretch the sum is the same.
TEST(Step, ALoadOnAStretchIsBorneByTheBase) {
  Model model;
  model.gravity_W.setZero();
  RodDescription damped = steel_wire({.elements = 40, .E_Pa = 200e9, .length_m = 0.2});
  damped.damping = {0.5, 0.5, 5e-3};
  model.rods.push_back(make_rod(damped));
  const Vector3d force(0, 2e-3, -1e-3);
  const auto settled = [&](const RodInputs& in, StepReport& report) {
    State state = straight(model);
    Scratch scratch(model);
    Inputs inputs;
    inputs.rods = {in};
    for (int n = 0; n < 3000; ++n) step(model, inputs, state, scratch, report);
    return state;
  };
  StepReport at_tip, stretch, at_end;
  RodInputs in;
  in.tip_force_W_N = force;
  const State tip = settled(in, at_tip);
  in = {};
  in.load = {0, 1e-3, force};
  EXPECT_EQ(first_difference(settled(in, at_end), tip), "");
  in.load = {0.05, 0.1, force};
  const State spread = settled(in, stretch);
  EXPECT_LT((stretch.rods[0].base_force_W_N + force).norm(), 0.01 * force.norm());
  EXPECT_LT((at_tip.rods[0].base_force_W_N + force).norm(), 0.01 * force.norm());
  EXPECT_GT(tip.rods[0].position[40].y(), 2 * spread.rods[0].position[40].y()) << "nearer to the base it bends it less";
  EXPECT_GT(spread.rods[0].position[40].y(), 0);
  in.load.force_W_N = Vector3d(std::nan(""), 0, 0);
  settled(in, stretch);
  EXPECT_TRUE(stretch.trouble & drive_not_finite);
}

// A cantilever of stiffness F / d in parallel with a spring k bends by F / (F / d + k); however stiff the spring, the
// rod is at rest immediately.
TEST(Step, ATetherIsASpringBesideTheRod) {
  Model model;
  model.gravity_W.setZero();
  RodDescription damped = steel_wire({.elements = 40, .E_Pa = 200e9, .length_m = 0.2});
  damped.damping = {0.5, 0.5, 5e-3};
  model.rods.push_back(make_rod(damped));
  State state = straight(model);
  Scratch scratch(model);
  StepReport report;
  Inputs inputs;
  inputs.rods.resize(1);
  RodInputs& in = inputs.rods[0];
  const auto tip_after = [&](int steps) {
    for (int n = 0; n < steps; ++n) step(model, inputs, state, scratch, report);
    return state.rods[0].position[40].y();
  };
  const double F = 1e-3;
  in.tip_force_W_N = Vector3d(0, F, 0);
  const double free_m = tip_after(3000);
  Tether& tether = in.tethers[1];
  tether = {0, Vector3d::Zero(), Vector3d::UnitY(), 2 * F / free_m, 0};
  EXPECT_NEAR(tip_after(3000), free_m / 3, 1e-3 * free_m);
  tether.along_W = Vector3d::UnitZ();
  EXPECT_NEAR(tip_after(3000), free_m, 1e-3 * free_m) << "across its direction it holds nothing";
  tether = {0, {state.rods[0].position[40].x(), 0, 0}, Vector3d::UnitZ(), 0, 2 * F / free_m};
  EXPECT_NEAR(tip_after(3000), free_m / 3, 1e-3 * free_m);
  in.tethers[0] = {0, Vector3d::Zero(), Vector3d::UnitY(), 2 * F / free_m, 0};
  EXPECT_NEAR(tip_after(3000), free_m / 5, 1e-3 * free_m) << "both hold it";

  in = {};
  tether = {0, Vector3d(0, 1e-3, 0), Vector3d::UnitY(), 1e6, 0};
  for (int n = 0; n < 50; ++n) EXPECT_NEAR(tip_after(1), 1e-3, 1e-6) << "step " << n;
  tether.across_N_m = std::nan("");
  tip_after(1);
  EXPECT_TRUE(report.trouble & drive_not_finite);
}

TEST(Step, SameBitsOnTwoThreadsAtOnce) {
  const Model model = three_rods();
  State states[2] = {straight(model), straight(model)};
  std::thread threads[2];
  for (int i = 0; i < 2; ++i)
    threads[i] = std::thread([&, i] {
      Scratch scratch(model);
      run(model, 0, 300, states[i], scratch);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(first_difference(states[0], states[1]), "");
}

TEST(Step, ARunResumedFromASavedStateGoesOnBitIdentically) {
  const Model model = three_rods();
  State uninterrupted = straight(model);
  Scratch kept(model);
  run(model, 0, 300, uninterrupted, kept);

  State first = straight(model);
  auto scratch = std::make_unique<Scratch>(model);
  run(model, 0, 137, first, *scratch);
  const std::vector<double> saved = save(first);
  scratch.reset();
  State resumed = straight(model);
  restore(saved, resumed);
  Scratch fresh(model);
  run(model, 137, 300, resumed, fresh);
  EXPECT_EQ(first_difference(uninterrupted, resumed), "");
  EXPECT_EQ(hash(uninterrupted), hash(resumed));
}

TEST(Step, ARodDoesNotNoticeTheOthers) {
  const Model all = three_rods();
  State together = straight(all);
  Scratch scratch(all);
  run(all, 0, 200, together, scratch);
  for (std::size_t r = 0; r < all.rods.size(); ++r) {
    Model one = all;
    one.rods = {all.rods[r]};
    State alone = straight(one);
    Scratch own(one);
    StepReport report;
    for (int i = 0; i < 200; ++i) {
      Inputs inputs;
      inputs.rods = {busy_inputs(all, i).rods[r]};
      step(one, inputs, alone, own, report);
    }
    EXPECT_EQ(first_difference(alone, State{200, {together.rods[r]}}), "") << r;
  }
}

TEST(Step, DoesNotAllocate) {
  const Model model = three_rods();
  State state = straight(model);
  Scratch scratch(model);
  StepReport report;
  std::vector<RodEquilibrium> equilibria;
  const Inputs busy = busy_inputs(model, 80);
  step(model, busy, state, scratch, report);
  find_equilibrium(model, busy, state, scratch, equilibria);
  const long before = allocations();
  for (int i = 0; i < 100; ++i) step(model, busy, state, scratch, report);
  find_equilibrium(model, busy, state, scratch, equilibria);
  EXPECT_NE(hash(state), 0u);
  EXPECT_EQ(allocations() - before, 0);
  const auto witness = std::make_unique<int>(1);  // to check that the counter works
  EXPECT_GT(allocations() - before, 0);
}

/// Previous contents of scratch must not matter: here it has seen joints at ends that are now free.
TEST(Step, DampedRodThatIsHeldAndFreedResumesBitIdentically) {
  RodDescription wire = steel_wire({.elements = 40, .length_m = 0.2});
  wire.damping.material_time_s = 3e-3;
  wire.sections[0].rest_curvature_per_m = Vector3d(3, -2, 1);
  Model model;
  model.rods.push_back(make_rod(wire));
  const auto run = [&](int from, int to, State& state, Scratch& scratch) {
    StepReport report;
    Inputs inputs;
    inputs.rods.resize(1);
    for (int i = from; i < to; ++i) {
      inputs.rods[0].tip.hold = i / 20 % 2 ? Hold::clamped : Hold::free;
      inputs.rods[0].base.hold = i / 50 % 2 ? Hold::pinned : Hold::clamped;
      step(model, inputs, state, scratch, report);
    }
  };
  State whole = straight(model), part = straight(model);
  Scratch kept(model), first(model), second(model);
  run(0, 300, whole, kept);
  run(0, 145, part, first);
  run(145, 300, part, second);
  EXPECT_EQ(first_difference(whole, part), "");
}

TEST(Step, StatesOfAnotherModelAreRefusedWhole) {
  const Model model = three_rods();
  State state = straight(model);
  std::vector<double> saved = save(state);
  saved.pop_back();
  const std::uint64_t before = hash(state);
  EXPECT_THROW(restore(saved, state), std::invalid_argument);
  EXPECT_EQ(hash(state), before);
}

TEST(Step, DifferencesAreNamed) {
  const Model model = three_rods();
  State a = straight(model), b = a;
  b.rods[1].velocity.at(2)[7] = 1e-300;
  EXPECT_EQ(first_difference(a, b).substr(0, 18), "rod 1, velocity[7]");
  EXPECT_NE(hash(a), hash(b));
}

// --- bad input -------------------------------------------------------------------------------------------------------

bool finite(const State& state) {
  bool all = true;
  for (const double number : save(state)) all = all && std::isfinite(number);
  return all;
}

TEST(BadInput, AbsurdDrivesAreLimitedAndFlagged) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* name;
    Vector3d velocity, turn_rate, force;
    std::uint32_t trouble;
  };
  const Vector3d zero = Vector3d::Zero();
  const Case cases[] = {
      {"100 m/s", {100, 0, 0}, zero, zero, drive_limited},
      {"100 m/s sideways", {0, 70, 70}, zero, zero, drive_limited},
      {"1e300 m/s", {-1e300, 1e300, 0}, zero, zero, drive_limited},
      {"NaN", {nan, 0, 0}, zero, zero, drive_not_finite},
      {"infinite turn", zero, {0, inf, 0}, zero, drive_not_finite},
      {"1e6 turns/s", zero, {6e6, 0, 0}, zero, drive_limited},
      {"a ton on the tip", zero, zero, {0, 0, -1e4}, load_limited},
      {"NaN on the tip", zero, zero, {0, nan, 0}, drive_not_finite},
  };
  const Model model = three_rods();
  for (const Case& c : cases) {
    State state = straight(model);
    Scratch scratch(model);
    StepReport report;
    Inputs inputs;
    inputs.rods.resize(3);
    inputs.rods[0].base.velocity_W_m_s = c.velocity;
    inputs.rods[0].base.turn_rate_W_rad_s = c.turn_rate;
    inputs.rods[0].tip_force_W_N = c.force;
    for (int i = 0; i < 300; ++i) {
      step(model, inputs, state, scratch, report);
      ASSERT_TRUE(report.trouble & c.trouble) << c.name;
      ASSERT_TRUE(finite(state)) << c.name << ", step " << i;
    }
    EXPECT_EQ(report.rods[1].trouble, 0u) << c.name << ": the other rods are not concerned";
    // And it recovers.
    inputs = {};
    inputs.rods.resize(3);
    for (int i = 0; i < 2000; ++i) step(model, inputs, state, scratch, report);
    EXPECT_TRUE(finite(state)) << c.name;
    EXPECT_EQ(report.trouble, 0u) << c.name;
    EXPECT_LT(report.rods[0].stretch, 1e-6) << c.name;
  }
}

TEST(BadInput, AllHoldsThrownAtRandomStayFinite) {
  const Model model = three_rods();
  State state = straight(model);
  Scratch scratch(model);
  StepReport report;
  std::uint64_t random = 1;
  const auto next = [&] { return (random = random * 6364136223846793005ull + 1442695040888963407ull) >> 33; };
  Inputs inputs;
  inputs.rods.resize(3);
  for (int i = 0; i < 3000; ++i) {
    if (i % 20 == 0)
      for (RodInputs& in : inputs.rods)
        for (EndDrive* d : {&in.base, &in.tip}) {
          d->hold = static_cast<Hold>(next() % 4);
          d->velocity_W_m_s = Vector3d::Constant(static_cast<double>(next() % 5) - 2);
          d->turn_rate_W_rad_s = Vector3d(0, static_cast<double>(next() % 400) - 200, 0);
        }
    step(model, inputs, state, scratch, report);
    ASSERT_TRUE(finite(state)) << i;
  }
}

/// Twisted until unsolvable, with its tip held: it must return to its hold by itself.
TEST(BadInput, OverTwistedSlackRodRecovers) {
  RodDescription wire = steel_wire({.elements = 200, .length_m = 0.3});
  wire.damping.drag_across_N_s_m2 = 0.007, wire.damping.drag_along_N_s_m2 = 0.0035;
  Bench bench = bench_of(wire, false);
  RodInputs& in = bench.inputs.rods[0];
  const auto run = [&](int ms) {
    int troubled = 0;
    for (int i = 0; i < ms; ++i) {
      bench.step();
      troubled += bench.report.trouble != 0;
    }
    return troubled;
  };
  in.tip.hold = Hold::clamped;
  in.tip.velocity_W_m_s = Vector3d(-0.03, 0, 0);
  run(1000);
  in.tip.velocity_W_m_s.setZero();
  in.tip.turn_rate_W_rad_s = Vector3d(20 * units::pi, 0, 0);
  run(2000);
  in.tip.turn_rate_W_rad_s.setZero();
  run(500);
  EXPECT_EQ(run(1000), 0);
  EXPECT_LT((bench.tip() - bench.rod().tip.p_W).norm(), 1e-9);
}

TEST(BadInput, PullingATautRodApartAndOverturningJointsAreFlagged) {
  Bench bench = steel_bench({.elements = 16, .gravity = false});
  RodInputs& in = bench.inputs.rods[0];
  in.tip.hold = Hold::clamped;
  in.tip.velocity_W_m_s = Vector3d(1e-3, 0, 0);
  for (int ms = 0; ms < 20; ++ms) bench.step();
  EXPECT_TRUE(bench.report.trouble & pulled_apart);
  in.tip.velocity_W_m_s = Vector3d(-1e-3, 0, 0);
  for (int ms = 0; ms < 20; ++ms) bench.step();
  in.tip.velocity_W_m_s.setZero();
  for (int ms = 0; ms < 200; ++ms) bench.step();
  EXPECT_EQ(bench.report.trouble, 0u);

  in.tip.hold = Hold::guided;
  in.tip_force_W_N = Vector3d(60, 0, 0);
  in.tip.turn_rate_W_rad_s = Vector3d(20 * units::pi, 0, 0);
  bool flagged = false;
  for (int ms = 0; ms < 790; ++ms) {  // 7.9 turns: a joint reaches pi at 8
    bench.step();
    flagged = flagged || bench.report.trouble & joint_overturned;
  }
  EXPECT_TRUE(flagged);
}

TEST(BadInput, ModelsOutOfRangeAreRefused) {
  Model model;
  EXPECT_THROW(check(model), std::invalid_argument);
  model = three_rods();
  EXPECT_NO_THROW(check(model));
  model.step_s = 0;
  EXPECT_THROW(check(model), std::invalid_argument);
  model.step_s = 1e-3;
  model.gravity_W.x() = NAN;
  EXPECT_THROW(check(model), std::invalid_argument);
  EXPECT_THROW(Scratch{model}, std::invalid_argument);  // such a model cannot be stepped
}

}  // namespace
}  // namespace ostium::core
