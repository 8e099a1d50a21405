/// Air in the line, in an artery, and out again.
#include "vascular/physiology/air.h"

#include <gtest/gtest.h>

#include "tests/vascular/anatomy/coronary_body.h"

namespace ostium::vascular {

using units::mL, units::mmHg;
namespace {

/// A heart of three arteries whose first needs 1.5 mL/s, with a guide in its ostium.
struct Airy : Body {
  explicit Airy(std::uint64_t seed = 0) {
    model.flow = make_flow_model(plain_tree({{-1, 80, 1e-3, 1.6e-3, Territory::lad}}), 1.5 * mL);
    model.contrast = make_contrast_model(model.flow);
    model.heart.seed = seed;
    state = make_state(model);
    inputs.contrast.tip = {TipPlace::coronary, 2, 1};
    run(20);
  }
  /// Pushes `volume_mL` of air in.
  void inject(double volume_mL) {
    add_to_line(volume_mL * mL, state.air);
    push(2, 1.5);
  }
  void push(double mL_s, double seconds) {
    inputs.contrast.iodine_kg_m3 = 0;
    (mL_s > 0 ? inputs.contrast.injection_m3_s : inputs.contrast.aspiration_m3_s) = std::fabs(mL_s) * mL;
    run(seconds);
    inputs.contrast.injection_m3_s = inputs.contrast.aspiration_m3_s = 0;
  }
  double supplied() const { return supply(model.flow, state.flow)[static_cast<int>(Territory::lad)]; }
  /// Seconds in the next minutes during which the muscle has less than half of what it needs.
  double starved_s(double seconds = 240) {
    double sum = 0;
    for (double t = 0; t < seconds; t += 0.5) run(0.5), sum += supplied() < 0.5 ? 0.5 : 0;
    return sum;
  }
};

TEST(Air, MovesWithTheLineAndIsDrawnOutAgain) {
  Airy b;
  add_to_line(0.5 * mL, b.state.air);
  b.push(2, 0.5);  // 1 mL of 2.5
  EXPECT_NEAR(b.state.air.line_at, 0.4, 0.01);
  EXPECT_EQ(in_muscle_m3(b.state.air), 0);
  b.push(-2, 0.7);
  EXPECT_EQ(b.state.air.line_m3, 0);
  EXPECT_DOUBLE_EQ(b.state.air.elsewhere_m3, 0.5 * mL);
  b.push(2, 2);
  EXPECT_EQ(in_muscle_m3(b.state.air), 0);
}

TEST(Air, NothingOfItIsLost) {
  for (const auto where : {TipPlace::coronary, TipPlace::left_sinus, TipPlace::aorta, TipPlace::outside}) {
    Airy b;
    b.inputs.contrast.tip = {where, where == TipPlace::coronary ? 2 : 0, 0.4};
    b.inject(0.5);
    const double came = in_muscle_m3(b.state.air);
    EXPECT_EQ(came > 0, where == TipPlace::coronary || where == TipPlace::left_sinus);
    b.run(20);
    EXPECT_NEAR(in_muscle_m3(b.state.air) + b.state.air.elsewhere_m3 + b.state.air.line_m3, 0.5 * mL, 1e-9 * mL);
    EXPECT_LE(in_muscle_m3(b.state.air), came);
  }
}

/// 0.15 mL: hardly a blip; 0.3 to 0.5 mL: a minute or two; more, longer; a low pressure, longer.
TEST(Air, SlowsFlowByItsVolumeAndByThePressureBehind) {
  const auto starved_s = [](double volume_mL, double mean_mmHg) {
    Airy b;
    b.model.air.fatal_share = 0;
    b.inject(volume_mL);
    // The same circulation throughout; only the pressure that drives the bubbles differs.
    b.model.air.leaves_s *= 93 / mean_mmHg;
    return b.starved_s();
  };
  EXPECT_LT(starved_s(0.15, 93), 12);
  EXPECT_GT(starved_s(0.4, 93), 60);
  EXPECT_LT(starved_s(0.4, 93), 120);
  EXPECT_GT(starved_s(0.5, 93), starved_s(0.4, 93));
  EXPECT_GT(starved_s(0.5, 40), 1.5 * starved_s(0.5, 93));
  Airy b;
  b.model.air.fatal_share = 0;
  b.inject(0.5);
  b.run(15);
  EXPECT_GT(ST_shift_mV(b.model.ischaemia, b.state.ischaemia), 0.05);
  b.run(400);
  EXPECT_LT(ST_shift_mV(b.model.ischaemia, b.state.ischaemia), 0.05);
  EXPECT_NEAR(b.supplied(), 1, 0.1);
}

/// 28 % of dogs died of 0.02 mL/kg.
TEST(Air, ALargeBubbleMakesSomeHeartsFibrillate) {
  const auto share = [](double volume_mL) {
    int fatal = 0;
    constexpr int people = 1000;
    for (int seed = 1; seed <= people; ++seed) fatal += is_fatal({}, static_cast<std::uint64_t>(seed), volume_mL * mL);
    return static_cast<double>(fatal) / people;
  };
  EXPECT_NEAR(share(1.5), 0.28, 3 * std::sqrt(0.28 * 0.72 / 1000));
  EXPECT_LT(share(0.15), 0.01);
  EXPECT_GT(share(4), 0.8);
  int fibrillate = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    Airy b(static_cast<std::uint64_t>(seed));
    b.inject(5);
    fibrillate += b.state.heart.rhythm == Rhythm::fibrillation;
  }
  EXPECT_GE(fibrillate, 8);
}

}  // namespace
}  // namespace ostium::vascular
