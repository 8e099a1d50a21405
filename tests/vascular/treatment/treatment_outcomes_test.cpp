/// What comes of a treatment: each outcome changes in the right direction if its cause is halved or doubled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/vascular/treatment/treatment_bench.h"

namespace ostium::vascular {
namespace {

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
                 return bench.report.balloons[0].waist;
               }),
               "strength");
}

TEST(Outcomes, ABalloonTakesLongerToEmptyThroughANarrowerTube) {
  expect_grows(with_cause([](double x) {
                 Bench bench({.change = [=](TreatmentModel& m) { m.balloons[0].filling_Pa_s_m3 *= x; }});
                 bench.run(8, 12);
                 const double full = bench.state.balloons[0].volume_m3;
                 double seconds = 0;
                 for (; seconds < 40 && bench.state.balloons[0].volume_m3 > 0.2 * full; seconds += 0.1)
                   bench.run(-1, 0.1);
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
    bench.device.balloons[0].drag_N = 2 * pull;
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
  expect_grows(with_cause([](double x) {
                 Bench bench({});
                 Injury& hole = bench.state.injury.injuries[0];
                 hole.kind = InjuryKind::perforation, hole.cell = 60, hole.hole_m2 = x * 0.3e-6;
                 bench.state.injury.count = 1, bench.device.balloons[0].balloon = -1;
                 bench.run(0, 1);
                 return hole.outside_m3;
               }),
               "area");
}

TEST(Outcomes, NitrateWidensByItsDoseHeparinThinsByIts) {
  expect_grows(with_cause([](double x) {
                 Bench bench({.stenosis = 0.1});
                 bench.device.balloons[0].balloon = -1;
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

}  // namespace
}  // namespace ostium::vascular
