/// Contrast in the muscle: rate and pressure fall with each injection and come back; saline does nothing.
#include "vascular/physiology/contrast_reaction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/vascular/anatomy/coronary_body.h"

namespace ostium::vascular {

using units::mL, units::mmHg;
namespace {

/// A person with one coronary artery, at rest.
struct Dosed : Body {
  explicit Dosed(Territory of) {
    const double mL_min = of == Territory::rca ? 75 : 150;
    model.flow = make_flow_model(plain_tree({{-1, 100, 1e-3, 1.6e-3, of}}), mL_min * units::mL_min);
    model.contrast = make_contrast_model(model.flow);
    state = make_state(model);
    inputs.heart.body.reflexes = true;
    inputs.contrast.tip.where = TipPlace::coronary;
    run(60);
  }
  struct Answer {
    double least_rate = 1e9, least_systolic_Pa = 1e9;
  };
  /// Injects, and looks on.
  Answer inject(double volume_m3, double iodine_kg_m3, double seconds) {
    constexpr double m3_s = 3.5 * mL;
    Answer least;
    inputs.contrast.iodine_kg_m3 = iodine_kg_m3;
    for (double t = 0; t < seconds; t += 0.1) {
      inputs.contrast.injection_m3_s = t < volume_m3 / m3_s ? m3_s : 0;
      run(0.1);
      least.least_rate = std::min(least.least_rate, state.heart.circulation.rate_1_min);
      least.least_systolic_Pa = std::min(least.least_systolic_Pa, state.heart.beat.systolic_Pa);
    }
    return least;
  }
};

TEST(ContrastReaction, ADoseWashesOutAndItsEffectIsALawOfWhatIsThere) {
  const ContrastReactionModel model;
  ContrastReactionState s;
  step(model, {0, 1e-3}, 0, s);
  for (int n = 0; n < 1000; ++n) step(model, {}, 8e-3, s);
  EXPECT_NEAR(s.in_muscle_kg[1], 1e-3 * std::exp(-1), 1e-9);
  CirculationInputs body;
  react(model, s, body);
  EXPECT_NEAR(body.rate_effect, model.rate[1] * (1 - std::exp(-2 * std::exp(-1))), 1e-6);
  EXPECT_LT(body.contraction, 1);
}

TEST(ContrastReaction, RateAndPressureFallAndComeBack) {
  for (Territory of : {Territory::lad, Territory::rca}) {
    const bool right = of == Territory::rca;
    const double full_m3 = (right ? 4 : 7) * mL;
    Dosed rest(of);
    rest.inject(full_m3, 350, 90);  // the line is full of it
    const double rate = rest.state.heart.circulation.rate_1_min, systolic_Pa = rest.state.heart.beat.systolic_Pa;
    Dosed b = rest;
    const auto least = b.inject(full_m3, 350, 20);
    // Dogs: left -3.7, right -6.7 %.
    EXPECT_NEAR(least.least_rate / rate, right ? 0.933 : 0.963, 0.015) << right;
    EXPECT_NEAR((systolic_Pa - least.least_systolic_Pa) / mmHg, right ? 6 : 8, 4) << right;
    b.run(30);
    EXPECT_NEAR(b.state.heart.circulation.rate_1_min, rate, 0.01 * rate);
    EXPECT_NEAR(b.state.heart.beat.systolic_Pa, systolic_Pa, 1.5 * mmHg);
    const auto half = Dosed(rest).inject(full_m3 / 2, 350, 20);
    EXPECT_GT(half.least_rate, least.least_rate + 0.3) << "half as much does less";
    EXPECT_GT(half.least_systolic_Pa, least.least_systolic_Pa);
  }
}

TEST(ContrastReaction, SalineDoesNothing) {
  Dosed b(Territory::rca);
  b.inject(8 * mL, 0, 20);
  EXPECT_EQ(b.state.reaction.in_muscle_kg[1], 0);
}

}  // namespace
}  // namespace ostium::vascular
