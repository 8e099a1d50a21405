/// Holes, flaps, covered stents and drugs: the orifice law, and that consequences follow their causes.
#include <gtest/gtest.h>

#include "tests/vascular/treatment/treatment_bench.h"

namespace ostium::vascular {

using units::mL, units::mmHg;
namespace {

/// The bench with the rest of the body: what leaks leaves its arteries, reflexes act, ischaemia weakens.
struct SickPerson : Bench {
  explicit SickPerson(const Setting& setting = {.stenosis = 0.1}) : Bench(setting) {
    device.balloons[0].balloon = -1;
    live(30);
    settle_reflex(blood.heart.circulation);
    inputs.heart.body.reflexes = true;
  }
  void live(double seconds, double gauge_atm = 0) {
    device.balloons[0].gauge_Pa = gauge_atm * atm;
    for (int n = 0; n < 1000 * seconds; ++n) {
      act(model.drugs, state.drugs, inputs.heart.body);
      inputs.heart.body.leak_m3_s = leak_m3_s(state);
      report = step(model, device, 1e-3, state, {physiology.flow, blood, inputs.occupied_m}, scratch);
      step(physiology, inputs, 1e-3, blood, blood_scratch);
      device.provocation = {}, device.shock_J = 0, device.doses = {};
    }
  }
  void perforate(double hole_m) {
    device.provocation = {Provoked::perforation, 100, hole_m};
    live(0.01);
  }
  double systolic_mmHg() const { return blood.heart.beat.systolic_Pa / mmHg; }
  double leak_mL_s() {
    double sum = 0;
    for (int n = 0; n < 860; ++n) live(1e-3), sum += leak_m3_s(state) / 860;
    return sum / mL;
  }
};

TEST(Leak, IsTheOrificeLaws) {
  Injury hole{.kind = InjuryKind::perforation, .cell = 0, .grade = 3};
  hole.hole_m2 = units::pi / 4 * 1e-6;
  // Q = 0.6 A sqrt(2 dp / rho) of 1 mm at 80 mmHg: 0.6 * 0.7854 mm2 * 4.497 m/s.
  EXPECT_NEAR(leak_m3_s(hole, 80 * mmHg) / mL, 2.119, 0.005);
  EXPECT_NEAR(leak_m3_s(hole, 40 * mmHg), leak_m3_s(hole, 80 * mmHg) / std::sqrt(2), 1e-12);
  EXPECT_EQ(leak_m3_s(hole, -1), 0);
  hole.clotted = 0.25;
  EXPECT_NEAR(leak_m3_s(hole, 80 * mmHg) / mL, 0.75 * 2.119, 0.005);
  hole.covered = true;
  EXPECT_EQ(leak_m3_s(hole, 80 * mmHg), 0);
}

TEST(Leak, ABalloonHoldsItAndOnlyWhileItIsUp) {
  SickPerson p;
  p.perforate(1e-3);
  EXPECT_GT(p.leak_mL_s(), 1.5);
  p.device.balloons[0].balloon = 0;
  p.live(8, 6);
  EXPECT_EQ(leak_m3_s(p.state), 0);
  p.live(9, -1);
  EXPECT_GT(p.leak_mL_s(), 1);
}

TEST(Leak, ACoveredStentKeepsItClosed) {
  for (const int covered : {0, 1}) {
    SickPerson p({.stenosis = 0.1, .stent = true, .change = [&](TreatmentModel& m) { m.stents[0].covered = covered; }});
    p.perforate(1e-3);
    p.device.balloons[0].balloon = 0;
    p.live(6, 12), p.live(9, -1);
    p.device.balloons[0].balloon = -1;
    p.live(1);
    EXPECT_EQ(leak_m3_s(p.state) > 0, covered == 0);
  }
}

/// Twice the area at least halves the time: 80 mmHg of systolic pressure.
TEST(Leak, TwiceTheHoleHalvesTheTimeToTamponade) {
  const auto time_s = [](double area_mm2) {
    SickPerson p;
    p.state.drugs.heparin_U = 10000;  // no clot
    p.perforate(std::sqrt(4 / units::pi * area_mm2) * 1e-3);
    double s = 0;
    for (; p.systolic_mmHg() > 80 && s < 2000; ++s) p.live(1);
    return s;
  };
  const double once = time_s(0.6), twice = time_s(1.2);
  EXPECT_LT(once, 1000);
  EXPECT_LE(twice, 0.5 * once + 1);
}

TEST(Leak, WithoutHeparinASmallHoleClots) {
  const auto left = [](double heparin_U, double hole_m) {
    Injury hole{.kind = InjuryKind::perforation, .cell = 0, .grade = 3};
    hole.hole_m2 = units::pi / 4 * hole_m * hole_m;
    DrugState drugs;
    drugs.heparin_U = heparin_U;
    for (int n = 0; n < 900; ++n) age(act_s({}, drugs), 1, hole);
    return 1 - hole.clotted;
  };
  EXPECT_EQ(left(10000, 0.3e-3), 1);
  EXPECT_EQ(left(0, 0.3e-3), 0);
  EXPECT_GT(left(0, 1e-3), left(0, 0.5e-3));
}

/// A and B change the reserve by at most 0.02, C by a loss of up to 35 % of the area, F stops flow; a stent holds it.
TEST(Flap, TheReserveFollowsTheLumenThatItLeaves) {
  const auto ffr = [](int grade) {
    SickPerson p;
    p.device.provocation = {Provoked::dissection, 100, static_cast<double>(grade)};
    p.live(0.01);
    for (Injury& one : p.state.injury.injuries) one.narrows = one.will_narrow;  // an hour later
    p.live(0.02);
    return ffr_model(p.physiology.flow, p.state.wall.radius_m, 150);
  };
  const double whole = ffr(0);
  EXPECT_NEAR(ffr(1), whole, 0.02);
  EXPECT_LE(ffr(2), whole);
  EXPECT_LT(ffr(3), ffr(1));
  EXPECT_LT(ffr(5), 0.5 * whole);
}

TEST(Provoked, FibrillationEndsByAShockOrNotAtAll) {
  int ended = 0;
  constexpr int persons = 20;
  for (int seed = 1; seed <= persons; ++seed) {
    SickPerson p({.stenosis = 0.1, .seed = static_cast<std::uint64_t>(seed)});
    p.device.provocation = {Provoked::fibrillation};
    p.live(10);
    EXPECT_GT(p.blood.heart.pulseless_s, 0);
    p.device.shock_J = 200;
    p.live(5);
    ended += p.blood.heart.rhythm == Rhythm::sinus;
  }
  // 64 to 95 % by person and delay.
  EXPECT_GE(ended, 13);
  EXPECT_LE(ended, persons);
}

TEST(Drugs, ProtamineTakesHeparinAwayInMinutes) {
  DrugModel m;
  m.others = {{"protamine", "", "mg", 5, 50, 450, {{DrugTarget::heparin, 100, 1, 60}}}};
  DrugState s = make_state(m);
  step(m, {.heparin_U = 5000}, 1e-3, s);
  EXPECT_GT(act_s(m, s), 290);
  step(m, {.drug = 0, .dose = 50}, 1e-3, s);
  for (int n = 0; n < 300000; ++n) step(m, {}, 1e-3, s);
  EXPECT_LT(act_s(m, s), 150);  // back in about 5 minutes
  EXPECT_GE(s.heparin_U, 0);
}

TEST(Drugs, EachActsInItsTimeAndWearsOff) {
  DrugModel m;
  m.others = {{"phenylephrine", "", "ug", 25, 500, 300, {{DrugTarget::resistance, 0.75, 100, 40}}}};
  DrugState s = make_state(m);
  const auto after = [&](double seconds) {
    for (int n = 0; n < 100 * seconds; ++n) step(m, {}, 1e-2, s);
    return effect_on(DrugTarget::resistance, m, s);
  };
  step(m, {.drug = 0, .dose = 100}, 1e-3, s);
  EXPECT_LT(after(5), 0.1);
  EXPECT_NEAR(after(85), 0.33, 0.05);  // peak after 1 to 2 minutes: 30 to 40 %
  EXPECT_LT(after(1200), 0.1);         // acts for 5 to 20 minutes
}

}  // namespace
}  // namespace ostium::vascular
