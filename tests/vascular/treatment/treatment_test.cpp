/// Balloons, stents, the wall and injuries: each outcome changes in the right direction if its cause is halved or
/// doubled.
#include "vascular/treatment/treatment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/vascular/treatment/treatment_bench.h"

namespace ostium::vascular {
namespace {

TEST(Balloon, OpensMoreWithPressureAndSizeLessWithCalcium) {
  const double usual = mld_after(8, {});
  EXPECT_GT(usual, 1.5);
  EXPECT_LT(mld_after(3, {}), 0.8 * usual);
  EXPECT_GT(mld_after(14, {}), usual);
  EXPECT_LT(mld_after(8, {.balloon_mm = 2}), usual);
  EXPECT_LT(mld_after(8, {.calcified = true}), 0.9 * usual);
  // Half and twice the strength of the plaque.
  const auto yield = [](double times) {
    return Setting{.change = [times](TreatmentModel& m) {
      for (PlaqueCell& cell : m.plaque.cells) cell.yield_Pa *= times;
    }};
  };
  EXPECT_GT(mld_after(6, yield(0.5)), mld_after(6, {}));
  EXPECT_LT(mld_after(6, yield(2)), mld_after(6, {}));
}

TEST(Balloon, SpringsBackMoreIfThePlaqueIsSofterSprung) {
  const auto recoil = [](double stiffness) {
    Bench bench({.change = [=](TreatmentModel& m) {
      for (PlaqueCell& cell : m.plaque.cells) cell.E_Pa *= stiffness;
    }});
    bench.run(10, 8);
    const double widest = bench.mld_mm();
    bench.run(-1, 14);
    return 1 - bench.mld_mm() / widest;
  };
  EXPECT_GT(recoil(0.5), recoil(1));
  EXPECT_GT(recoil(1), recoil(2));
  EXPECT_GT(recoil(1), 0.05);
  EXPECT_LT(recoil(1), 0.3);
}

TEST(Balloon, AWaistStandsAtLowPressureAndGivesWay) {
  Bench bench({});
  bench.run(3, 6);
  EXPECT_LT(bench.report.balloons[0].waist, 0.7);
  EXPECT_GT(bench.report.balloons[0].dog_bone, 1.3);
  bench.run(14, 6);
  EXPECT_GT(bench.report.balloons[0].waist, 0.8);
  EXPECT_LT(bench.report.balloons[0].dog_bone, 1.25);
}

TEST(Balloon, AThinCalciumRingBreaksAndAThickOneDoesNotYieldTo20Atm) {
  const auto waist = [](double thickness_m, double gauge_atm) {
    Bench bench({.compliance = Compliance::non, .change = [=](TreatmentModel& m) {
                   for (PlaqueCell& cell : m.plaque.cells) cell.calcium_arc_share = 0.95, cell.calcium_m = thickness_m;
                 }});
    bench.run(gauge_atm, 12);
    return bench.report.balloons[0].waist;
  };
  EXPECT_GT(waist(0.3e-3, 20), 0.9);
  EXPECT_LT(waist(1.5e-3, 20), 0.8);
}

TEST(Balloon, RecoilsByAFifthOrMoreWithoutAStent) {
  Bench bench({});
  bench.run(12, 8);
  const double widest = bench.mld_mm();
  bench.run(-1, 14);
  const double recoil = 1 - bench.mld_mm() / widest;  // 20 to 30 % published for plain balloons
  EXPECT_GT(recoil, 0.15);
  EXPECT_LT(recoil, 0.30);
}

TEST(Balloon, AShaftsTipOpensANarrowingElastically) {
  Bench bench({.stenosis = 0.85, .shift_mm = -15, .change = [](TreatmentModel& m) {
                 m.balloons[0].tip_m = 3.5e-3, m.balloons[0].tip_radius_m = 0.3e-3;
               }});
  const double narrow_mm = bench.mld_mm();
  bench.run(0, 0.1);
  const std::vector<double>& radius_m = bench.state.wall.radius_m;
  const double tip_at_m = bench.device.balloons[0].shaft.middle_m + 7.5 * mm + 3.5 * mm;
  for (std::size_t k = 0; k < radius_m.size(); ++k) {
    const double s_m = bench.physiology.flow.tree.cells[k].s_m;
    if (s_m > bench.device.balloons[0].shaft.middle_m && s_m < tip_at_m) {
      EXPECT_GT(radius_m[k], 0.3e-3);
    }
  }
  bench.device.balloons[0].balloon = -1;
  bench.run(0, 0.1);
  EXPECT_NEAR(bench.mld_mm(), narrow_mm, 1e-6);
}

TEST(Balloon, EmptiesUnderVacuumAndHardlyWithout) {
  Bench bench({});
  bench.run(8, 6);
  const double full = bench.state.balloons[0].volume_m3;
  Bench left = bench;
  left.run(0, 6);
  EXPECT_GT(left.state.balloons[0].volume_m3, 0.4 * full);
  bench.run(-1, 10);
  EXPECT_LT(bench.state.balloons[0].volume_m3, 0.15 * full);
}

TEST(Balloon, SlipsWhenItSitsOnAShoulder) {
  const auto slip = [](double shift_mm, double friction) {
    Bench bench({.stenosis = 0.75, .calcified = true, .shift_mm = shift_mm, .change = [=](TreatmentModel& m) {
                   m.balloons[0].friction *= friction;
                 }});
    bench.run(8, 6);
    return bench.slip_m();
  };
  EXPECT_LT(std::fabs(slip(0, 1)), 0.2 * mm);
  EXPECT_GT(slip(8, 1), 0.5 * mm);  // out of the narrowing, in the direction in which it is already displaced
  EXPECT_LT(slip(-8, 1), -0.5 * mm);
  EXPECT_GT(slip(8, 0.5), slip(8, 2));
}

/// In a hard artery that widens by `slope` (of the radius), and everywhere narrower than the balloon.
Bench in_a_cone(double slope, double friction) {
  Bench bench({.stenosis = 0, .balloon_mm = 3, .balloon_length_mm = 40, .change = [=](TreatmentModel& m) {
                 m.balloons[0].friction = friction;
               }});
  for (std::size_t c = 0; c < bench.model.plaque.cells.size(); ++c) {
    PlaqueCell& cell = bench.model.plaque.cells[c];
    const double from_middle_m = (static_cast<double>(c) - 99.5) * 0.4 * mm;
    cell.healthy_m = cell.diseased_m = std::max(0.5 * mm, 1.1 * mm + slope * from_middle_m);
    cell.E_Pa = 3000 * atm, cell.yield_Pa = 1e4 * atm;
  }
  bench.state.wall = make_plaque_state(bench.model.plaque);
  bench.run(8, 25);
  return bench;
}

TEST(Balloon, OnAConeItSeedsAtTheAngleThatFrictionSays) {
  const double slope = 0.012;
  const Bench held = in_a_cone(slope, 1.2 * slope), sliding = in_a_cone(slope, 0.8 * slope),
              back = in_a_cone(-slope, 0.8 * slope), level = in_a_cone(0, 1e-4);
  const auto steep = [](const Bench& bench) {
    return bench.report.balloons[0].axial_N / bench.report.balloons[0].pressed_N;
  };
  EXPECT_NEAR(steep(held), slope, 0.05 * slope) << "what the wall pushes along, over what it presses";
  EXPECT_LT(held.slip_m(), 0.2 * mm) << "a little, while only its narrow end touches";
  EXPECT_GT(sliding.slip_m(), 2 * mm) << "towards the wider end";
  EXPECT_LT(back.slip_m(), -2 * mm);
  // It stays where its shaft and friction hold it together.
  const BalloonReport& at = sliding.report.balloons[0];
  const BalloonModel& own = sliding.model.balloons[0];
  EXPECT_NEAR(sliding.device.balloons[0].shaft.holds_N_m * sliding.slip_m(), at.axial_N - own.friction * at.pressed_N,
              0.05 * own.friction * at.pressed_N);
  EXPECT_LT(std::fabs(level.slip_m()), 0.02 * mm);
}

TEST(Balloon, StopsTheFlowMeanwhile) {
  Bench bench({.stenosis = 0.4});  // in a tighter one the folded balloon blocks flow, too
  bench.run(0, 3);
  const double open = bench.blood.flow.flow_m3_s[20];
  bench.run(8, 8);
  EXPECT_TRUE(bench.report.balloons[0].seals);
  EXPECT_LT(bench.blood.flow.flow_m3_s[150], 1e-3 * open);
  bench.run(-1, 14);
  EXPECT_GT(bench.blood.flow.flow_m3_s[150], 0.5 * open);
}

TEST(Balloon, BurstsAboveItsRatedPressureNeverBelow) {
  int burst = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Bench bench({.seed = seed});
    bench.run(bench.model.balloons[0].rated_Pa / atm, 6);
    EXPECT_EQ(bench.state.balloons[0].burst, 0) << seed;
    bench.run(1.2 * bench.model.balloons[0].rated_Pa / atm, 4);
    burst += bench.state.balloons[0].burst;
  }
  EXPECT_GT(burst, 2);
  EXPECT_LT(burst, 12);
  Bench bench({.seed = 3});
  bench.run(2 * bench.model.balloons[0].rated_Pa / atm, 8);
  EXPECT_EQ(bench.state.balloons[0].burst, 1);
  EXPECT_LT(bench.state.balloons[0].pressure_Pa, 0.1 * atm);
  // The contrast of the burst balloon is in the vessel and accounted for.
  EXPECT_GT(bench.blood.contrast.injected_kg, 0);
  EXPECT_NEAR(accounted_kg(bench.blood.contrast), bench.blood.contrast.injected_kg,
              1e-9 * bench.blood.contrast.injected_kg);
}

TEST(Balloon, RefusesSizesThatThereAreNot) {
  EXPECT_THROW(make_balloon(Compliance::semi, 12 * mm, 15 * mm), std::invalid_argument);
  EXPECT_THROW(make_balloon(Compliance::non, 3 * mm, -1 * mm), std::invalid_argument);
  EXPECT_THROW(make_stent(9 * mm, 18 * mm), std::invalid_argument);
}

TEST(Stent, StaysOpenWhereABalloonAloneLetsTheWallSpringBack) {
  const Bench bench = stented(12);
  EXPECT_EQ(bench.state.stents[0].where, StentState::deployed);
  Bench plain({.balloon_length_mm = 18});
  plain.inflate(12);
  EXPECT_GT(bench.mld_mm(), 1.05 * plain.mld_mm());
  EXPECT_GT(bench.recoil(), 0.03);
  EXPECT_LT(bench.recoil(), 0.10);
}

TEST(Stent, WiderWithPressureRecoilsLessIfStronger) {
  EXPECT_LT(stented(6).stent_mm(), stented(12).stent_mm());
  EXPECT_LT(stented(12).stent_mm(), stented(16).stent_mm());
  const auto strength = [](double times) {
    return stented(12, {.change = [=](TreatmentModel& m) { m.stents[0].hoop_Pa *= times; }}).recoil();
  };
  EXPECT_GT(strength(0.5), strength(1));
  EXPECT_GT(strength(1), strength(2));
  const auto spring = [](double times) {
    // Where the wall does not press on it.
    return stented(12, {.stenosis = 0, .change = [=](TreatmentModel& m) { m.stents[0].yield *= times; }}).recoil();
  };
  EXPECT_LT(spring(0.5), spring(1));
  EXPECT_LT(spring(1), spring(2));
}

TEST(Stent, ShortensAsItOpensAsItsStrutsKeepTheirLength) {
  Bench bench = stented(12);
  const StentModel& m = bench.model.stents[0];
  const StentState& s = bench.state.stents[0];
  const auto [from, to] = span_of(s);
  EXPECT_LT(to - from, m.length_m);
  EXPECT_GT(to - from, 0.95 * m.length_m);
  // Each strut has kept its length in space.
  const int around = 2 * m.crowns;
  for (int k = 0; k < m.rings; ++k)
    for (int j = 0; j < around; ++j) {
      const double dz = s.along_m[k * around + j] - s.along_m[k * around + (j + 1) % around];
      const double chord = 2 * s.radius_m[k] * std::sin(units::pi / around);
      EXPECT_NEAR(std::hypot(dz, chord), m.strut_length_m(), 0.03 * m.strut_length_m());
    }
}

TEST(Stent, IsPostDilatedByALargerBalloon) {
  Bench bench({.balloon_mm = 2.5, .balloon_length_mm = 18, .stent = true, .change = [](TreatmentModel& m) {
                 m.balloons.push_back(make_balloon(Compliance::non, 3.25 * mm, 15 * mm)), m.stent_on.push_back(-1);
               }});
  bench.inflate(10);
  const double before = bench.stent_mm();
  bench.device.balloons[0].balloon = 1;
  bench.inflate(16);
  EXPECT_GT(bench.stent_mm(), before + 0.3);
}

TEST(Stent, SlipsOffItsBalloonIfPulledHardAndOnlyThen) {
  Bench gentle({.stent = true});
  gentle.device.balloons[0].drag_N = -1.0;
  gentle.run(0, 5);
  EXPECT_EQ(gentle.state.stents[0].shift_m, 0);
  Bench hard({.stent = true});
  hard.device.balloons[0].drag_N = -3.0;
  hard.run(0, 0.3);
  EXPECT_LT(hard.state.stents[0].shift_m, -1 * mm);
  hard.run(0, 5);
  EXPECT_EQ(hard.state.stents[0].where, StentState::lost);
}

TEST(Stent, AnEdgeThatPushesShortensItAndItStaysSo) {
  Bench bench = stented(12);
  const auto [from, to] = span_of(bench.state.stents[0]);
  bench.device.edge_m = from + 3 * mm, bench.device.edge_N = 0.3;
  bench.run(0, 0.5);
  EXPECT_NEAR(span_of(bench.state.stents[0]).first, from, 0.05 * mm);  // too gentle
  bench.device.edge_N = 1;
  bench.run(0, 0.5);
  bench.device.edge_m = -1;
  bench.run(0, 0.5);
  const auto [after, end] = span_of(bench.state.stents[0]);
  EXPECT_GT(after, from + 1 * mm);
  EXPECT_LT(end - after, to - from - 1 * mm);
}

TEST(Stent, ASecondDeviceDoesNotPassOneThatIsNotOpen) {
  // A stent that was deployed almost unopened.
  Bench bench({.stenosis = 0.7, .calcified = true, .stent = true, .change = [](TreatmentModel& m) {
                 m.balloons.push_back(make_balloon(Compliance::semi, 3 * mm, 15 * mm)), m.stent_on.push_back(-1);
               }});
  StentState& stent = bench.state.stents[0];
  stent.where = StentState::deployed, stent.branch = 0, stent.middle_m = bench.middle_m;
  for (double& r : stent.radius_m) r = 0.40 * mm;
  for (double& r : stent.rest_m) r = 0.40 * mm;
  bench.device.balloons[0].balloon = 1;
  bench.run(0, 0.01);
  EXPECT_TRUE(bench.report.blocked[0]);
  bench.run(12, 5);
  EXPECT_LT(bench.state.wall.peak_m[100], 0.6 * mm);  // it was not inflated there either
}

TEST(Injury, ChancesAreThePublishedOnesAndGrowWithTheirCauses) {
  EXPECT_NEAR(chance(dissection_hazard(1, false, false, 15 * mm)), 0.30, 0.02);
  EXPECT_LT(chance(perforation_hazard(1.1, false)), 0.01);
  EXPECT_GT(chance(perforation_hazard(1.3, false)), 0.05);
  EXPECT_GT(perforation_hazard(1.3, false), 20 * perforation_hazard(1.1, false));
  EXPECT_GT(dissection_hazard(1.2, false, false, 15 * mm), 2 * dissection_hazard(1, false, false, 15 * mm));
  EXPECT_GT(dissection_hazard(1, true, false, 15 * mm), dissection_hazard(1, false, false, 15 * mm));
  EXPECT_GT(dissection_hazard(1, false, true, 15 * mm), dissection_hazard(1, false, false, 15 * mm));
  EXPECT_GT(dissection_hazard(1, false, false, 30 * mm), dissection_hazard(1, false, false, 15 * mm));
  // Over seeds: among 400 at ratio 1, the number of tears matches the probability (4 standard errors).
  int torn = 0, major = 0;
  PlaqueModel plaque;
  plaque.cells = {{.diseased_m = 0.8 * mm, .healthy_m = 1.5 * mm, .E_Pa = 1, .yield_Pa = 1, .hardening_Pa = 1}};
  PlaqueState wall = make_plaque_state(plaque);
  wall.peak_m[0] = 1.5 * mm;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    InjuryState s;
    for (int n = 0; n < 50; ++n) judge_stretch({.seed = seed}, plaque, wall, 15 * mm, false, 0, s);
    torn += s.count > 0, major += s.count > 0 && s.injuries[0].grade >= 2;
  }
  EXPECT_NEAR(torn / 400.0, 0.30, 4 * std::sqrt(0.3 * 0.7 / 400));
  EXPECT_NEAR(major / 400.0, 0.09, 4 * std::sqrt(0.09 * 0.91 / 400));
}

TEST(Injury, AWirePerforatesByForceAndTimeSoonerInASmallArtery) {
  const auto hazard = [](double force, double radius, double seconds) {
    InjuryState s;
    for (int n = 0; n < seconds * 1000; ++n) judge_wire({.seed = 5}, 3, radius, force, 1e-3, 0, s);
    return s.wire_H;
  };
  EXPECT_EQ(hazard(0.04, 0.5 * mm, 10), 0);
  EXPECT_GT(hazard(0.3, 0.5 * mm, 1), 0);
  EXPECT_GT(hazard(0.3, 0.5 * mm, 2), hazard(0.3, 0.5 * mm, 1));
  EXPECT_GT(hazard(0.6, 0.5 * mm, 1), hazard(0.3, 0.5 * mm, 1));
  EXPECT_GT(hazard(0.3, 0.4 * mm, 1), hazard(0.3, 0.8 * mm, 1));
}

TEST(Injury, ContrastLeavesThroughAHoleAndIsAccountedFor) {
  Bench bench({});
  Injury& hole = bench.state.injury.injuries[0];
  hole.kind = InjuryKind::perforation, hole.cell = 60, hole.grade = 3, hole.hole_m2 = 0.4e-6;
  bench.state.injury.count = 1;
  bench.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
  bench.inputs.contrast.injection_m3_s = 2e-6;
  bench.device.balloons[0].balloon = -1;
  bench.run(0, 4);
  EXPECT_GT(hole.outside_m3, 1e-6);
  EXPECT_GT(hole.outside_kg, 20e-6);
  EXPECT_GE(bench.blood.contrast.outside_kg, hole.outside_kg);
  const ContrastState& c = bench.blood.contrast;
  EXPECT_NEAR(accounted_kg(c), c.injected_kg, 1e-9 * c.injected_kg);
}

// --- each outcome with its cause halved and doubled: half, as it is, twice -----------------------------------------

TEST(Treatment, SpasmNarrowsAndNitrateRelievesIt) {
  Bench bench({.stenosis = 0.1});
  bench.device.balloons[0].balloon = -1;
  bench.state.spasm[0] = 0.5;
  bench.run(0, 1);
  EXPECT_NEAR(bench.blood.radius_m[20], 0.75 * mm, 0.01 * mm);
  bench.device.doses.nitrate_ug = 200;
  bench.run(0, 1e-3);
  bench.device.doses = {};
  bench.run(0, 60);
  EXPECT_GT(bench.blood.radius_m[20], 1.45 * mm);
}

TEST(Treatment, TheSameTwiceToTheBitAndFromASavedState) {
  const auto all = [](Bench& b) {
    std::vector<double> out(core::count_fields(b.state) + core::count_fields(b.blood));
    core::put_fields(b.blood, core::put_fields(b.state, out.data()));
    return out;
  };
  const Setting setting{.calcified = true, .stent = true, .seed = 2};
  Bench a(setting), b(setting);
  a.run(10, 3), b.run(10, 3);
  EXPECT_EQ(all(a), all(b));
  const std::vector<double> saved = all(a);
  a.run(-1, 4);
  Bench c(setting);
  core::take_fields(core::take_fields(saved.data(), c.state), c.blood);
  c.run(-1, 4);
  EXPECT_EQ(all(a), all(c));
}

}  // namespace
}  // namespace ostium::vascular
