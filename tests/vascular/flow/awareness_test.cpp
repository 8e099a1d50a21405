/// Pain and consciousness follow what causes them, in the order in which a closed artery shows itself.
#include "vascular/physiology/awareness.h"

#include <gtest/gtest.h>

#include "tests/vascular/anatomy/coronary_body.h"

namespace ostium::vascular {

using units::mmHg;
namespace {

/// A heart whose left anterior descending closes.
struct Occluded : Body {
  explicit Occluded(std::uint64_t seed = 0) {
    model.flow = make_flow_model(plain_tree({{-1, 80, 1e-3, 1.6e-3, Territory::lad}}), 1.5e-6);
    model.contrast = make_contrast_model(model.flow);
    model.ischaemia = ischaemia_of(seed), model.awareness = awareness_of(seed);
    state = make_state(model);
    run(20);
  }
  void close(bool closed) {
    inputs.occupied_m.assign(state.radius_m.size(), 0);
    if (closed) inputs.occupied_m[10] = state.radius_m[10];
  }
  double lost() const {
    CirculationInputs body;
    weaken(state.ischaemia, body);
    return body.left_lost / left_share[static_cast<int>(Territory::lad)];
  }
};

TEST(Awareness, AClosedArteryShowsInContractionThenSTThenPain) {
  Occluded b;
  b.close(true);
  double weak_s = 0, ST_s = 0, pain_s = 0;
  for (double t = 0.1; t < 120; t += 0.1) {
    b.run(0.1);
    if (weak_s == 0 && b.lost() > 0.5) weak_s = t;
    if (ST_s == 0 && ST_shift_mV(b.model.ischaemia, b.state.ischaemia) > 0.1) ST_s = t;
    if (pain_s == 0 && b.state.awareness.pain > 2) pain_s = t;
  }
  EXPECT_GT(weak_s, 0);
  EXPECT_LT(weak_s, ST_s);
  EXPECT_NEAR(ST_s, 19, 6);
  EXPECT_GT(pain_s, ST_s + 2);
  EXPECT_LT(pain_s, 60);
  EXPECT_GT(b.state.awareness.pain, 5);
  EXPECT_TRUE(b.state.awareness.awake);
  b.close(false);
  b.run(120);
  EXPECT_LT(b.state.awareness.pain, 1);
}

TEST(Awareness, AThirdFeelNothing) {
  int silent = 0;
  constexpr int people = 300;
  for (int seed = 1; seed <= people; ++seed) {
    AwarenessState s;
    IschaemiaState closed;
    closed.late = {0.9, 0, 0};
    for (int n = 0; n < 200; ++n) step(awareness_of(static_cast<std::uint64_t>(seed)), closed, 93 * mmHg, 1, s);
    silent += s.pain < 2;
  }
  EXPECT_NEAR(static_cast<double>(silent) / people, 1.0 / 3, 3 * std::sqrt(2.0 / 9 / people));
}

TEST(Awareness, WithoutAPulseConsciousnessGoesInSecondsAndComesBack) {
  const auto lost_s = [](double mean_mmHg) {
    AwarenessState s;
    double t = 0;
    for (; t < 300 && s.awake; t += 0.01) step({}, {}, mean_mmHg * mmHg, 0.01, s);
    return t;
  };
  EXPECT_GT(lost_s(0), 5);
  EXPECT_LT(lost_s(0), 10);
  EXPECT_GT(lost_s(35), 2 * lost_s(0));
  EXPECT_GE(lost_s(50), 300);
  AwarenessState s{.pain = 0, .oxygen = 0, .awake = false};
  double back = 0;
  for (; !s.awake && back < 60; back += 0.01) step({}, {}, 90 * mmHg, 0.01, s);
  EXPECT_GT(back, 3);
  EXPECT_LT(back, 20);
  Occluded b;
  b.state.heart.rhythm = Rhythm::fibrillation;
  b.run(25);
  EXPECT_FALSE(b.state.awareness.awake);
}

}  // namespace
}  // namespace ostium::vascular
