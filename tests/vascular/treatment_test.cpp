/// Balloons, stents, the wall and injuries: each outcome changes in the right direction if its cause is halved or
/// doubled.
#include "vascular/treatment/treatment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/base/units.h"

namespace ostium::vascular {

using units::atm, units::mL_min;
namespace {

using units::mm;

struct Setting {
  double stenosis = 0.7, length_mm = 10, healthy_mm = 3;  ///< diameter
  bool calcified = false, eccentric = false;
  Compliance compliance = Compliance::semi;
  double balloon_mm = 3, balloon_length_mm = 15;
  bool stent = false;
  double shift_mm = 0;  ///< of the device from the lesion's middle
  std::uint64_t seed = 0;
  std::function<void(TreatmentModel&)> change = {};
};

/// A straight artery of 80 mm with a lesion in the middle, and its treatment.
struct Bench {
  PhysiologyModel physiology{.heart = {}, .ischaemia = {}, .flow = {}, .contrast = {}, .line = {}};
  TreatmentModel model;
  PhysiologyState blood;
  TreatmentState state;
  PhysiologyInputs inputs;
  TreatmentInputs device;
  PhysiologyScratch blood_scratch;
  TreatmentScratch scratch;
  TreatmentReport report;
  double middle_m = 40 * mm;

  explicit Bench(const Setting& o) {
    FlowTree tree = plain_tree({{-1, 200, 0.4 * mm, o.healthy_mm / 2 * mm, Territory::rca}});
    for (FlowCell& cell : tree.cells) {
      const double x = std::fabs(cell.s_m - middle_m) / (o.length_mm / 2 * mm);
      if (x < 1) cell.diseased_m *= 1 - o.stenosis * std::min(1.0, (1 - x) / 0.3);
    }
    physiology.flow = make_flow_model(tree, 60 * mL_min);
    physiology.contrast = make_contrast_model(physiology.flow);
    const Lesion lesion{.branch = "branch 0",
                        .from_m = middle_m - o.length_mm / 2 * mm,
                        .length_m = o.length_mm * mm,
                        .stenosis = o.stenosis,
                        .eccentric = o.eccentric,
                        .calcified = o.calcified};
    model.plaque = make_plaque_model(tree, {lesion});
    model.injury.seed = o.seed;
    model.balloons = {make_balloon(o.compliance, o.balloon_mm * mm, o.balloon_length_mm * mm)};
    model.balloons[0].seed = o.seed;
    model.stent_on = {-1};
    if (o.stent) model.stents = {make_stent(o.balloon_mm * mm, o.balloon_length_mm * mm)}, model.stent_on = {0};
    if (o.change) o.change(model);
    model.paths = all_paths(tree);
    blood = make_state(physiology);
    state = make_state(model, tree);
    device.balloon = 0, device.branch = 0, device.middle_m = middle_m + o.shift_mm * mm;
  }
  void run(double gauge_atm, double seconds) {
    device.gauge_Pa = gauge_atm * atm;
    for (int n = 0; n < 1000 * seconds; ++n) {
      report = step(model, device, 1e-3, state, {physiology.flow.tree, blood, inputs.occupied_m}, scratch);
      step(physiology, inputs, 1e-3, blood, blood_scratch);
    }
  }
  /// Inflates, holds, and deflates under vacuum.
  void inflate(double gauge_atm) { run(gauge_atm, 5), run(-1, 9), run(0, 0.1); }
  double mld_mm() const {
    return 2e3 * *std::min_element(state.wall.radius_m.begin() + 50, state.wall.radius_m.begin() + 150);
  }
  double stent_mm() const {
    const auto& r = state.stents[0].radius_m;
    return 2e3 * std::accumulate(r.begin() + 2, r.end() - 2, 0.0) / static_cast<double>(r.size() - 4);
  }
  double recoil() const {
    const StentState& s = state.stents[0];
    double sum = 0;
    for (std::size_t k = 0; k < s.radius_m.size(); ++k) sum += 1 - s.radius_m[k] / s.peak_m[k];
    return sum / static_cast<double>(s.radius_m.size());
  }
};

double mld_after(double gauge_atm, const Setting& setting) {
  Bench bench(setting);
  bench.inflate(gauge_atm);
  return bench.mld_mm();
}

TEST(Balloon, OpensMoreWithPressureAndSizeLessWithCalcium) {
  const double usual = mld_after(8, {});
  EXPECT_GT(usual, 1.5);
  EXPECT_LT(mld_after(3, {}), 0.8 * usual);
  EXPECT_GT(mld_after(14, {}), usual);
  EXPECT_LT(mld_after(8, {.balloon_mm = 2}), usual);
  EXPECT_LT(mld_after(5, {.calcified = true}), 0.7 * mld_after(5, {}));
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
  EXPECT_LT(bench.report.balloon.waist, 0.7);
  EXPECT_GT(bench.report.balloon.dog_bone, 1.3);
  bench.run(9, 6);
  EXPECT_GT(bench.report.balloon.waist, 0.9);
  EXPECT_LT(bench.report.balloon.dog_bone, 1.1);
  Bench hard({.calcified = true});
  hard.run(6, 6);
  EXPECT_LT(hard.report.balloon.waist, 0.75);
  hard.run(13, 6);
  EXPECT_GT(hard.report.balloon.waist, 0.9);
}

TEST(Balloon, EmptiesUnderVacuumAndHardlyWithout) {
  Bench bench({});
  bench.run(8, 6);
  const double full = bench.state.balloon.volume_m3;
  Bench left = bench;
  left.run(0, 6);
  EXPECT_GT(left.state.balloon.volume_m3, 0.4 * full);
  bench.run(-1, 10);
  EXPECT_LT(bench.state.balloon.volume_m3, 0.15 * full);
}

TEST(Balloon, SlipsWhenItSitsOnAShoulder) {
  const auto slip = [](double shift_mm, double friction) {
    Bench bench({.stenosis = 0.75, .calcified = true, .shift_mm = shift_mm, .change = [=](TreatmentModel& m) {
                   m.balloons[0].friction *= friction;
                 }});
    bench.run(8, 6);
    return bench.state.balloon.slip_m;
  };
  EXPECT_LT(std::fabs(slip(0, 1)), 0.2 * mm);
  EXPECT_GT(slip(8, 1), 0.5 * mm);  // out of the narrowing, in the direction in which it is already displaced
  EXPECT_LT(slip(-8, 1), -0.5 * mm);
  EXPECT_GT(slip(8, 0.5), slip(8, 2));
}

TEST(Balloon, StopsTheFlowMeanwhile) {
  Bench bench({.stenosis = 0.4});  // in a tighter one the folded balloon blocks flow, too
  bench.run(0, 3);
  const double open = bench.blood.flow.flow_m3_s[20];
  bench.run(8, 8);
  EXPECT_TRUE(bench.report.balloon.seals);
  EXPECT_LT(bench.blood.flow.flow_m3_s[150], 1e-3 * open);
  bench.run(-1, 14);
  EXPECT_GT(bench.blood.flow.flow_m3_s[150], 0.5 * open);
}

TEST(Balloon, BurstsAboveItsRatedPressureNeverBelow) {
  int burst = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Bench bench({.seed = seed});
    bench.run(bench.model.balloons[0].rated_Pa / atm, 6);
    EXPECT_EQ(bench.state.balloon.burst, 0) << seed;
    bench.run(1.2 * bench.model.balloons[0].rated_Pa / atm, 4);
    burst += bench.state.balloon.burst;
  }
  EXPECT_GT(burst, 2);
  EXPECT_LT(burst, 12);
  Bench bench({.seed = 3});
  bench.run(2 * bench.model.balloons[0].rated_Pa / atm, 8);
  EXPECT_EQ(bench.state.balloon.burst, 1);
  EXPECT_LT(bench.state.balloon.pressure_Pa, 0.1 * atm);
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

Bench stented(double gauge_atm, Setting setting = {}) {
  setting.stent = true, setting.balloon_length_mm = 18;
  Bench bench(setting);
  bench.inflate(gauge_atm);
  return bench;
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
    return stented(12, {.stenosis = 0.1, .change = [=](TreatmentModel& m) { m.stents[0].yield *= times; }}).recoil();
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
  bench.device.balloon = 1;
  bench.inflate(16);
  EXPECT_GT(bench.stent_mm(), before + 0.3);
}

TEST(Stent, SlipsOffItsBalloonIfPulledHardAndOnlyThen) {
  Bench gentle({.stent = true});
  gentle.device.drag_N = -1.0;
  gentle.run(0, 5);
  EXPECT_EQ(gentle.state.stents[0].shift_m, 0);
  Bench hard({.stent = true});
  hard.device.drag_N = -3.0;
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
  bench.device.balloon = 1;
  bench.run(0, 0.01);
  EXPECT_TRUE(bench.report.blocked);
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
  hole.kind = InjuryKind::perforation, hole.cell = 60, hole.grade = 3;
  bench.state.injury.count = 1;
  bench.inputs.contrast.tip = {TipPlace::coronary, 0, 1};
  bench.inputs.contrast.injection_m3_s = 2e-6;
  bench.device.balloon = -1;
  bench.run(0, 4);
  EXPECT_GT(hole.outside_m3, 1e-6);
  EXPECT_GT(hole.outside_kg, 20e-6);
  EXPECT_GE(bench.blood.contrast.outside_kg, hole.outside_kg);
  const ContrastState& c = bench.blood.contrast;
  EXPECT_NEAR(accounted_kg(c), c.injected_kg, 1e-9 * c.injected_kg);
}

// --- each outcome with its cause halved and doubled: half, as it is, twice -----------------------------------------

struct Three {
  double half, same, twice;
};
template <class Of>
Three with_cause(Of&& of) {
  return {of(0.5), of(1.0), of(2.0)};
}
void expect_grows(const Three& x, const char* what) {
  EXPECT_LT(x.half, x.same) << what;
  EXPECT_LT(x.same, x.twice) << what;
}
void expect_falls(const Three& x, const char* what) { expect_grows({x.twice, x.same, x.half}, what); }

TEST(Outcomes, AResidualStenosisGrowsWithThePlaquesStrengthAndStiffness) {
  const auto residual = [](double strength, double stiffness) {
    return 1 - mld_after(6, {.change =
                                 [=](TreatmentModel& m) {
                                   for (PlaqueCell& cell : m.plaque.cells)
                                     cell.yield_Pa *= strength, cell.E_Pa *= stiffness;
                                 }}) /
                   3;
  };
  expect_grows(with_cause([&](double x) { return residual(x, 1); }), "strength");
  EXPECT_NE(residual(1, 0.5), residual(1, 2));
}

TEST(Outcomes, AWaistIsDeeperInHarderPlaque) {
  expect_falls(with_cause([](double x) {
                 Bench bench({.change = [=](TreatmentModel& m) {
                   for (PlaqueCell& cell : m.plaque.cells) cell.yield_Pa *= x;
                 }});
                 bench.run(4, 5);
                 return bench.report.balloon.waist;
               }),
               "strength");
}

TEST(Outcomes, ABalloonTakesLongerToEmptyThroughANarrowerTube) {
  expect_grows(with_cause([](double x) {
                 Bench bench({.change = [=](TreatmentModel& m) { m.balloons[0].filling_Pa_s_m3 *= x; }});
                 bench.run(8, 12);
                 const double full = bench.state.balloon.volume_m3;
                 double seconds = 0;
                 for (; seconds < 40 && bench.state.balloon.volume_m3 > 0.2 * full; seconds += 0.1) bench.run(-1, 0.1);
                 return seconds;
               }),
               "resistance");
}

TEST(Outcomes, BurstsAreMoreFrequentTheHigherThePressure) {
  const auto share = [](double over) {
    int burst = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      BalloonModel m = make_balloon(Compliance::semi, 3e-3, 15e-3);
      m.seed = seed;
      burst += burst_Pa(m) < (1 + over) * m.rated_Pa;
    }
    return burst / 200.0;
  };
  expect_grows({share(0.08), share(0.16), share(0.32)}, "over the rated pressure");
  EXPECT_EQ(share(0), 0);
}

TEST(Outcomes, AStentForeshortensMoreTheWiderItOpensAndTheShorterItsStruts) {
  const auto shortened = [](double gauge_atm, double height) {
    const Bench bench =
        stented(gauge_atm, {.stenosis = 0.3, .change = [=](TreatmentModel& m) { m.stents[0].height_m *= height; }});
    const auto [from, to] = span_of(bench.state.stents[0]);
    return 1 - (to - from) / bench.model.stents[0].length_m;
  };
  EXPECT_LT(shortened(6, 1), shortened(12, 1));
  EXPECT_LT(shortened(12, 1), shortened(16, 1));
  expect_falls({shortened(12, 0.8), shortened(12, 1), shortened(12, 2)}, "length of struts");
}

TEST(Outcomes, AStentTooSmallLiesOffTheWall) {
  const auto lies = [](double balloon_mm) {
    Bench bench = stented(10, {.stenosis = 0.2, .healthy_mm = 3.5, .balloon_mm = balloon_mm});
    return apposition(bench.model.stents[0], bench.state.stents[0], bench.model.paths[0], bench.state.wall);
  };
  const Apposition small = lies(2.5), fair = lies(3), good = lies(3.5);
  EXPECT_LT(small.share, fair.share + 1e-9);
  EXPECT_LT(fair.share, good.share);
  EXPECT_GT(small.worst_m, fair.worst_m);
  EXPECT_GT(fair.worst_m, good.worst_m);
}

TEST(Outcomes, AStentIsLostSoonerTheLooserItIsCrimpedAndTheHarderItIsPulled) {
  const auto lost_after_s = [](double held, double pull) {
    Bench bench({.stent = true, .change = [=](TreatmentModel& m) { m.stents[0].held_N *= held; }});
    bench.device.drag_N = 2 * pull;
    double seconds = 0;
    for (; seconds < 10 && bench.state.stents[0].where != StentState::lost; seconds += 0.1) bench.run(0, 0.1);
    return seconds;
  };
  expect_grows(with_cause([&](double x) { return lost_after_s(x, 1); }), "crimp");
  expect_falls(with_cause([&](double x) { return lost_after_s(1, x); }), "pull");
}

TEST(Outcomes, AnEdgeDeformsAStentByItsForceAgainstThatOfTheStruts) {
  const auto shortened = [](double strength, double push) {
    Bench bench = stented(12, {.change = [=](TreatmentModel& m) { m.stents[0].crush_N *= strength; }});
    const auto [from, to] = span_of(bench.state.stents[0]);
    bench.device.edge_m = from + 3 * mm, bench.device.edge_N = 0.7 * push;
    bench.run(0, 0.5);
    return span_of(bench.state.stents[0]).first - from;
  };
  EXPECT_GT(shortened(0.5, 1), 1 * mm);
  EXPECT_LT(shortened(2, 1), 0.05 * mm);
  EXPECT_LT(shortened(1, 0.5), 0.05 * mm);
  EXPECT_GT(shortened(1, 2), 1 * mm);
}

/// Number of dissections and perforations among 300 seeds at a stretch.
std::pair<int, int> injured(double ratio, double length_m, bool calcified) {
  std::pair<int, int> out;
  PlaqueModel plaque;
  plaque.cells = {{.diseased_m = 0.8 * mm, .healthy_m = 1.5 * mm, .E_Pa = 1, .yield_Pa = 1, .hardening_Pa = 1}};
  plaque.cells[0].calcified = calcified;
  PlaqueState wall = make_plaque_state(plaque);
  wall.peak_m[0] = ratio * 1.5 * mm;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    InjuryState s;
    judge_stretch({.seed = seed}, plaque, wall, length_m, false, 0, s);
    for (const Injury& injury : s.injuries) {
      out.first += injury.kind == InjuryKind::dissection;
      out.second += injury.kind == InjuryKind::perforation;
    }
  }
  return out;
}

TEST(Outcomes, DissectionsAndPerforationsFollowStretchLengthAndCalcium) {
  // The stretch beyond the healthy size, halved and doubled.
  const auto at = [](double over) { return injured(1 + over, 15 * mm, false); };
  expect_grows({at(0.1).first * 1.0, at(0.2).first * 1.0, at(0.4).first * 1.0}, "dissections");
  expect_grows({at(0.15).second * 1.0, at(0.3).second * 1.0, at(0.6).second * 1.0}, "perforations");
  expect_grows(with_cause([](double x) { return injured(1, x * 15 * mm, false).first * 1.0; }), "length");
  EXPECT_GT(injured(1, 15 * mm, true).first, injured(1, 15 * mm, false).first);
  EXPECT_GT(injured(1.3, 15 * mm, true).second, injured(1.3, 15 * mm, false).second);
}

TEST(Outcomes, MoreIsLostThroughALargerHole) {
  const auto outside_m3 = [](double grade) {
    Bench bench({});
    Injury& hole = bench.state.injury.injuries[0];
    hole.kind = InjuryKind::perforation, hole.cell = 60, hole.grade = grade;
    bench.state.injury.count = 1, bench.device.balloon = -1;
    bench.run(0, 1);
    return hole.outside_m3;
  };
  expect_grows({outside_m3(1), outside_m3(2), outside_m3(3)}, "grade");
}

TEST(Outcomes, NitrateWidensByItsDoseHeparinThinsByIts) {
  expect_grows(with_cause([](double x) {
                 Bench bench({.stenosis = 0.1});
                 bench.device.balloon = -1;
                 bench.device.doses.nitrate_ug = 200 * x;
                 bench.run(0, 1e-3);
                 bench.device.doses = {};
                 bench.run(0, 40);
                 return bench.blood.radius_m[20];
               }),
               "nitrate");
  expect_grows(with_cause([](double x) {
                 DrugModel model;
                 DrugState s;
                 step(model, {.heparin_U = 5000 * x}, 1e-3, s);
                 return act_s(model, s);
               }),
               "heparin");
}

TEST(Treatment, SpasmNarrowsAndNitrateRelievesIt) {
  Bench bench({.stenosis = 0.1});
  bench.device.balloon = -1;
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
