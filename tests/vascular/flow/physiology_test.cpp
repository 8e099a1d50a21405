/// Heart and flow: identities, and that each responds to its causes in the right direction.
#include "vascular/physiology/physiology.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/vascular/anatomy/coronary_body.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/treatment/treatment.h"

namespace ostium::vascular {

using units::mL, units::mL_min, units::mmHg;
namespace {

TEST(Heart, MeanPressureDropIsResistanceTimesOutput) {
  for (double rate : {50.0, 70.0, 110.0}) {
    Body body;
    body.inputs.heart.rate_1_min = rate;
    body.run(30);
    double sum = 0, out = 0;
    constexpr int steps = 30000;
    for (int n = 0; n < steps; ++n) {
      step(body.model, body.inputs, 1e-3, body.state, body.scratch);
      const CirculationState& now = body.state.heart.circulation;
      sum += (now.arteries_m3 / body.model.heart.circulation.arteries_m3_Pa - now.venous_Pa) / steps;
      out += now.aortic_m3_s / steps;
    }
    EXPECT_NEAR(sum, body.model.heart.circulation.resistance_Pa_s_m3 * out, 0.005 * sum);
  }
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

TEST(Heart, AnInjectionIsNoBeatOfTheTrace) {
  Body body;
  body.inputs.contrast.tip = {TipPlace::coronary, 2, 1};
  body.run(6);
  const double mean = body.state.line.mean_Pa, pulse = body.state.line.pulse_Pa;
  // Short ones, that begin and end anywhere in a beat: what the line reads while it fills again is no diastole.
  for (int i = 0; i < 12; ++i) {
    body.inputs.contrast.injection_m3_s = 3e-6;
    body.run(0.3);
    body.inputs.contrast.injection_m3_s = 0;
    for (int n = 0; n < 20; ++n) {
      body.run(0.1);
      const Trace trace = body.state.line.trace;
      EXPECT_TRUE(trace == Trace::normal || trace == Trace::absent) << trace_name(trace);
      EXPECT_NEAR(body.state.line.mean_Pa, mean, 0.05 * mean);
      EXPECT_NEAR(body.state.line.pulse_Pa, pulse, 0.15 * pulse);
    }
    EXPECT_EQ(body.state.line.trace, Trace::normal);
    body.run(0.07);
  }
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
