/// Contrast: identities, and that it responds to its causes in the right direction.
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/vascular/anatomy/coronary_body.h"

namespace ostium::vascular {

using units::mL;
namespace {

TEST(Contrast, AUniformConcentrationStaysAsItIs) {
  Body body;
  body.run(5);
  ContrastState& c = body.state.contrast;
  const auto& tree = body.model.flow.tree;
  const std::size_t n = tree.cells.size();
  c.sinus_kg = {100 * body.model.contrast.sinus_m3, 100 * body.model.contrast.sinus_m3};
  const auto fill = [&] {
    for (std::size_t cell = 0; cell < n; ++cell)
      for (int k = 0; k < layers; ++k)
        c.sheath_kg[k * n + cell] = 100 * body.model.contrast.share[k] * tree.cells[cell].length_m * units::pi *
                                    body.state.radius_m[cell] * body.state.radius_m[cell];
  };
  fill();
  for (int i = 0; i < 100; ++i) {
    c.sinus_kg = {100 * body.model.contrast.sinus_m3, 100 * body.model.contrast.sinus_m3};
    body.run(8e-3);
  }
  for (std::size_t cell = 0; cell < n; ++cell) {
    const double area = units::pi * body.state.radius_m[cell] * body.state.radius_m[cell];
    EXPECT_NEAR(concentration(c, body.model.flow, static_cast<int>(cell), area), 100, 0.5);
  }
}

struct Injected {
  double in_artery_kg_m3 = 0, sinus_kg = 0, selective = 0;
};
Injected inject(double rate_mL_s, double shaft_m = 0, double covered_seconds = 2) {
  Body body;
  body.run(20);
  std::fill(body.state.contrast.line_kg.begin(), body.state.contrast.line_kg.end(), 350 * 2.5e-6 / line_cells);
  body.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
  body.inputs.contrast.injection_m3_s = rate_mL_s * mL, body.inputs.contrast.shaft_m = shaft_m;
  Injected out;
  out.selective = body.run(covered_seconds).selective;
  const double area = units::pi * body.state.radius_m[20] * body.state.radius_m[20];
  out.in_artery_kg_m3 = concentration(body.state.contrast, body.model.flow, 20, area);
  out.sinus_kg = body.state.contrast.sinus_kg[0] + body.state.contrast.aorta_kg[0];
  return out;
}

TEST(Contrast, PaleBelowTheFlowRefluxAboveIt) {
  const Injected slow = inject(0.4), half = inject(0.8), usual = inject(1.6), fast = inject(3.2);
  EXPECT_LT(slow.in_artery_kg_m3, 0.6 * half.in_artery_kg_m3);
  EXPECT_LT(half.in_artery_kg_m3, 0.75 * usual.in_artery_kg_m3);
  EXPECT_NEAR(fast.in_artery_kg_m3, 350, 10);
  EXPECT_LT(slow.sinus_kg, 1e-9);
  EXPECT_LT(usual.sinus_kg, fast.sinus_kg);
  EXPECT_NEAR(slow.selective, 1, 1e-9);
  EXPECT_LT(fast.selective, 0.7);
}

TEST(Contrast, AShaftInTheGuideTakesAwayTheRate) {
  EXPECT_GT(inject(3, 0).in_artery_kg_m3, 300);
  EXPECT_LT(inject(3, 0.6e-3).in_artery_kg_m3, 0.8 * inject(3, 0.18e-3).in_artery_kg_m3);
}

TEST(Contrast, NegativeRatesAreRefused) {
  Body body;
  body.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
  for (double rate : {-1e-6, std::numeric_limits<double>::quiet_NaN()}) {
    body.inputs.contrast.injection_m3_s = rate;
    EXPECT_TRUE(body.run(0.1).refused);
  }
  EXPECT_EQ(body.state.contrast.injected_m3, 0);
}

TEST(Contrast, HangsUpBehindABlockageAndWashesOutElsewhere) {
  Body body;
  body.run(10);
  const int shut = 80;  // in the first limb
  std::fill(body.state.contrast.line_kg.begin(), body.state.contrast.line_kg.end(), 350 * 2.5e-6 / line_cells);
  body.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
  body.inputs.contrast.injection_m3_s = 2e-6;
  body.run(2);
  body.inputs.contrast.injection_m3_s = 0;
  body.inputs.occupied_m.assign(body.state.radius_m.size(), 0);
  body.inputs.occupied_m[shut] = body.state.radius_m[shut];
  body.run(4);
  const auto at = [&](int cell) {
    return concentration(body.state.contrast, body.model.flow, cell,
                         units::pi * std::pow(body.state.radius_m[cell], 2));
  };
  EXPECT_GT(at(shut - 5), 50);  // contrast stagnates
  EXPECT_GT(at(shut + 5), 50);
  EXPECT_LT(at(10), 5);   // the trunk is washed out
  EXPECT_LT(at(115), 5);  // and so is the other limb
}

TEST(Contrast, AspirationBringsBackWhatIsThere) {
  Body body;
  body.run(5);
  body.inputs.contrast.tip = {TipPlace::left_sinus, 0, 0};
  body.state.contrast.sinus_kg[0] = 100 * body.model.contrast.sinus_m3;
  const double before = accounted_kg(body.state.contrast);
  body.inputs.contrast.aspiration_m3_s = 2e-6;
  body.run(2);
  EXPECT_GT(body.state.contrast.aspirated_kg + body.state.contrast.line_kg.back(), 0);
  EXPECT_NEAR(accounted_kg(body.state.contrast), before, 1e-9 * before);
}

// --- each outcome with its cause halved and doubled ----------------------------------------------------------------

}  // namespace
}  // namespace ostium::vascular
