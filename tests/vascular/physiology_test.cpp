/// Heart, flow and contrast: identities, and that each responds to its causes in the right direction.
#include "vascular/physiology/physiology.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/treatment/treatment.h"

namespace ostium::vascular {

using units::mL, units::mL_min, units::mmHg;
namespace {

/// A right coronary artery of 100 mm with one branch half-way.
PhysiologyModel model_of(const std::vector<PlainBranch>& branches = {{-1, 50, 1e-3, 1.6e-3, Territory::rca},
                                                                     {0, 50, 1e-3, 1.3e-3, Territory::rca},
                                                                     {0, 40, 1e-3, 0.9e-3, Territory::rca}}) {
  PhysiologyModel model{.heart = {},
                        .ischaemia = {},
                        .flow = make_flow_model(plain_tree(branches), 90 * mL_min),
                        .contrast = {},
                        .line = {}};
  model.contrast = make_contrast_model(model.flow);
  return model;
}

struct Body {
  PhysiologyModel model = model_of();
  PhysiologyState state = make_state(model);
  PhysiologyInputs inputs;
  PhysiologyScratch scratch;

  ContrastReport run(double seconds) {
    ContrastReport last;
    for (int n = 0; n < 1000 * seconds; ++n)
      if (const ContrastReport r = step(model, inputs, 1e-3, state, scratch); r.rate_m3_s > 0 || r.refused) last = r;
    return last;
  }
  /// Mean over complete beats.
  double flow(int cell, int beats = 5) {
    double sum = 0;
    int steps = 0;
    for (int left = beats; left > 0; ++steps) {
      const double before = state.heart.phase;
      step(model, inputs, 1e-3, state, scratch);
      sum += state.flow.flow_m3_s[cell];
      left -= state.heart.phase < before;
    }
    return sum / steps;
  }
  void narrow(int from, int to, double stenosis) {
    for (int c = from; c < to; ++c) state.radius_m[c] = (1 - stenosis) * model.flow.tree.cells[c].healthy_m;
  }
};

TEST(Heart, MeanPressureIsResistanceTimesOutput) {
  for (double rate : {50.0, 70.0, 110.0}) {
    Body body;
    body.inputs.heart.rate_1_min = rate;
    body.run(30);
    double sum = 0, out = 0;
    constexpr int steps = 30000;
    for (int n = 0; n < steps; ++n) {
      step(body.model, body.inputs, 1e-3, body.state, body.scratch);
      sum += body.state.heart.windkessel_Pa / steps, out += body.state.heart.ejection_m3_s / steps;
    }
    EXPECT_NEAR(sum, body.model.heart.resistance_Pa_s_m3 * out, 0.005 * sum);
  }
}

TEST(Heart, EjectionIntegratesToTheStroke) {
  double sum = 0;
  for (int i = 0; i < 100000; ++i) sum += ejection_shape((i + 0.5) / 100000) / 100000;
  EXPECT_NEAR(sum, 1, 1e-4);
}

TEST(Heart, ExtrasystolesComeEarlyWithoutAJumpAndAreFollowedByAPause) {
  HeartModel model;
  HeartState s;
  std::vector<double> lengths, kinds;
  double before = 0, start = 0;
  for (int n = 0; n < 60000; ++n) {
    step(model, {.irritation = n > 10000 && n < 40000 ? 1.0 : 0.0}, 1e-3, s);
    const double moved = s.phase - before + (s.phase < before ? 1 : 0);
    EXPECT_LT(moved, 4.2 * phase_speed(before, 70) * 1e-3);
    EXPECT_GT(moved, 0);
    if (s.phase < before) lengths.push_back(s.time_s - start), kinds.push_back(s.ectopic), start = s.time_s;
    before = s.phase;
  }
  int ectopic = 0;
  for (std::size_t i = 1; i + 1 < kinds.size(); ++i) {
    if (kinds[i] == 0) continue;
    ++ectopic;
    if (kinds[i - 1] == 0) {
      EXPECT_LT(lengths[i], 0.9 * 60 / 70);  // the extrasystole comes early,
    }
    if (kinds[i + 1] == 0) {
      EXPECT_GT(lengths[i + 1], 1.2 * 60 / 70);  // and a pause follows
    }
  }
  EXPECT_GT(ectopic, 5);
  EXPECT_EQ(kinds.back(), 0);
  for (std::size_t i = 2; i < 10; ++i) EXPECT_NEAR(lengths[i], 60.0 / 70, 2e-3);
}

TEST(Heart, TheLineReadsWhatItsEndHoleMeets) {
  Body body;
  const auto read = [&] {
    body.run(6);
    return body.state.line.trace;
  };
  body.inputs.contrast.tip = {TipPlace::coronary, 2, 1};
  EXPECT_EQ(read(), Trace::normal);
  const double mean = body.state.line.mean_Pa, pulse = body.state.line.pulse_Pa;
  body.inputs.tip_covered = 0.9;
  EXPECT_EQ(read(), Trace::damped);
  EXPECT_LT(body.state.line.mean_Pa, 0.8 * mean);
  EXPECT_LT(body.state.line.pulse_Pa, 0.6 * pulse);
  body.inputs.tip_covered = 0;
  // The catheter fills the ostium: behind it, pressure is that of the compressed myocardium.
  body.model.flow.squeeze = {0.74, 0.7, 0.8};
  body.inputs.occupied_m.assign(body.state.radius_m.size(), 0);
  body.inputs.occupied_m[0] = body.state.radius_m[0];
  EXPECT_EQ(read(), Trace::ventricularised);
  EXPECT_GT(body.state.line.pulse_Pa, pulse);
  body.inputs.occupied_m.clear();
  body.inputs.wire_in_catheter = true;
  EXPECT_EQ(read(), Trace::absent);
  body.inputs.wire_in_catheter = false, body.inputs.tip_in_ventricle = true;
  body.inputs.contrast.tip.where = TipPlace::aorta;
  EXPECT_EQ(read(), Trace::ventricle);
}

TEST(Flow, WhatGoesInComesOutAtEveryCell) {
  Body body;
  body.run(10);
  const FlowTree& tree = body.model.flow.tree;
  for (std::size_t c = 0; c < tree.cells.size(); ++c) {
    double out = body.state.flow.leak_m3_s[c];
    for (std::size_t d = c + 1; d < tree.cells.size(); ++d)
      if (tree.cells[d].upstream == static_cast<int>(c)) out += body.state.flow.flow_m3_s[d];
    EXPECT_NEAR(body.state.flow.flow_m3_s[c], out, 1e-12);
  }
}

TEST(Flow, RestFlowIsKeptByTheMuscleUntilItCanOpenNoFurther) {
  // Flow relative to the same artery without a lesion: hardly less at 50 %, much less at 90 %.
  std::vector<double> flows;
  for (double stenosis : {0.0, 0.5, 0.7, 0.9}) {
    Body body;
    body.narrow(20, 30, stenosis);
    body.run(60);
    flows.push_back(body.flow(0));
  }
  EXPECT_GT(flows[1], 0.95 * flows[0]);
  EXPECT_GT(flows[2], 0.85 * flows[0]);
  EXPECT_LT(flows[3], 0.5 * flows[0]);
}

TEST(Flow, FractionalFlowReserveFallsWithStenosisAndLength) {
  const auto ffr = [](double stenosis, int cells) {
    Body body;
    body.narrow(20, 20 + cells, stenosis);
    return ffr_model(body.model.flow, body.state.radius_m, 60);
  };
  EXPECT_GT(ffr(0, 10), 0.95);
  EXPECT_GT(ffr(0.3, 10), ffr(0.6, 10));
  EXPECT_GT(ffr(0.6, 5), ffr(0.6, 10));
  EXPECT_GT(ffr(0.6, 10), ffr(0.6, 20));
  EXPECT_LT(ffr(0.8, 10), 0.5);
}

TEST(Flow, ABalloonStopsItAndTheMuscleAsksForMoreAfterwards) {
  Body body;
  body.run(20);
  const double rest = body.flow(0);
  body.inputs.occupied_m.assign(body.state.radius_m.size(), 0);
  body.inputs.occupied_m[10] = body.state.radius_m[10];
  body.run(30);
  EXPECT_LT(body.flow(11), 1e-4 * rest);
  EXPECT_LT(body.state.flow.pressure_Pa[20], 60 * mmHg);
  body.inputs.occupied_m.clear();
  body.run(2);
  EXPECT_GT(body.flow(0, 2), 1.5 * rest);
  body.run(60);
  EXPECT_NEAR(body.flow(0), rest, 0.05 * rest);
}

TEST(Flow, NoReflowAndAShaftSlowIt) {
  const auto with = [](double no_reflow, double shaft_m) {
    Body body;
    body.narrow(20, 30, 0.6);
    std::fill(body.state.flow.no_reflow.begin(), body.state.flow.no_reflow.end(), no_reflow);
    body.inputs.occupied_m.assign(body.state.radius_m.size(), shaft_m);
    body.run(40);
    return body.flow(0);
  };
  const double free = with(0, 0);
  EXPECT_LT(with(0.9, 0), 0.6 * free);
  EXPECT_LT(with(0.95, 0), with(0.9, 0));
  EXPECT_LT(with(0, 0.5e-3), with(0, 0.25e-3));
  EXPECT_LT(with(0, 0.25e-3), free);
}

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

TEST(Outcomes, ExtrasystolesAreMoreFrequentTheMoreTheVentricleIsTouched) {
  const auto ectopics = [](double irritation) {
    HeartModel model;
    HeartState s;
    int count = 0;
    for (int n = 0; n < 120000; ++n) {
      const bool before = s.ectopic;
      step(model, {.irritation = irritation}, 1e-3, s);
      count += s.ectopic > before;
    }
    return count;
  };
  EXPECT_EQ(ectopics(0), 0);
  EXPECT_LT(ectopics(0.25), ectopics(0.5));
  EXPECT_LT(ectopics(0.5), ectopics(1));
}

TEST(Outcomes, STShiftsSoonerAndFartherTheLessFlows) {
  const auto shift_mV = [](double supply, double seconds, double time) {
    IschaemiaModel model;
    model.time_s *= time;
    IschaemiaState s;
    for (int n = 0; n < 100 * seconds; ++n) step(model, {supply, 1, 1}, 0.01, s);
    return ST_shift_mV(model, s);
  };
  EXPECT_GT(shift_mV(0.15, 30, 1), shift_mV(0.3, 30, 1));
  EXPECT_GT(shift_mV(0.3, 30, 1), shift_mV(0.6, 30, 1));
  EXPECT_LT(shift_mV(0, 10, 1), shift_mV(0, 20, 1));
  EXPECT_LT(shift_mV(0, 20, 1), shift_mV(0, 40, 1));
  EXPECT_GT(shift_mV(0, 20, 0.5), shift_mV(0, 20, 1));
  EXPECT_GT(shift_mV(0, 20, 1), shift_mV(0, 20, 2));
}

TEST(Outcomes, ContrastComesLaterWhenLessFlows) {
  const auto arrives_s = [](double lost) {
    Body body;
    std::fill(body.state.flow.no_reflow.begin(), body.state.flow.no_reflow.end(), lost);
    for (auto& tone : body.state.flow.tone) tone = 1;
    body.model.flow.tone_s = 1e12;
    body.run(10);
    std::fill(body.state.contrast.line_kg.begin(), body.state.contrast.line_kg.end(), 350 * 2.5e-6 / line_cells);
    body.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
    body.inputs.contrast.injection_m3_s = 2e-6;
    const int cell = 90;
    const double area = units::pi * std::pow(body.state.radius_m[cell], 2);
    double t = 0;
    for (; t < 20 && concentration(body.state.contrast, body.model.flow, cell, area) < 50; t += 0.01) body.run(0.01);
    return t;
  };
  // All of the flow, half, a quarter.
  const double all = arrives_s(0), half = arrives_s(0.5), quarter = arrives_s(0.75);
  EXPECT_GT(half, 1.4 * all);
  EXPECT_GT(quarter, 1.4 * half);
}

TEST(Outcomes, ATraceIsDampedByHowMuchOfTheHoleIsCovered) {
  const auto pulse = [](double covered) {
    Body body;
    body.inputs.contrast.tip = {TipPlace::coronary, 2, 1};
    body.inputs.tip_covered = covered;
    body.run(6);
    return body.state.line.pulse_Pa;
  };
  EXPECT_GT(pulse(0.2), pulse(0.4));
  EXPECT_GT(pulse(0.4), pulse(0.8));
}

TEST(Physiology, AStateCopiedFieldByFieldGoesOnBitIdentically) {
  Body a;
  a.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
  a.inputs.contrast.injection_m3_s = 1e-6;
  a.inputs.heart.irritation = 0.5;
  a.run(3.003);
  std::vector<double> saved(core::count_fields(a.state));
  core::put_fields(a.state, saved.data());
  Body b;
  b.inputs = a.inputs;
  core::take_fields(saved.data(), b.state);
  a.run(2), b.run(2);
  EXPECT_EQ(core::first_different_field(a.state, b.state), "");
}

TEST(Drugs, HeparinRaisesTheClottingTimeNitrateWidensAndItFades) {
  DrugModel model;
  DrugState s;
  EXPECT_NEAR(act_s(model, s), 130, 1e-9);
  step(model, {.heparin_U = 70 * model.weight_kg, .nitrate_ug = 200}, 1e-3, s);
  EXPECT_GT(act_s(model, s), 250);
  EXPECT_LT(act_s(model, s), 350);
  const auto run = [&](double seconds) {
    for (int n = 0; n < seconds * 100; ++n) step(model, {}, 0.01, s);
  };
  run(40);
  const double early = s.nitrate;
  EXPECT_GT(early, 0.4);
  run(600);
  EXPECT_LT(s.nitrate, 0.3 * early);
  const double later = act_s(model, s);
  run(model.heparin_half_life_s);
  EXPECT_NEAR(act_s(model, s) - 130, (later - 130) / 2, 1e-3 * later);
}

}  // namespace
}  // namespace ostium::vascular
