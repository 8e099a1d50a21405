/// A guide that injects against a wall tears it as often as its hazard says, and makes what is torn run on.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/vascular/treatment/treatment_bench.h"

namespace ostium::vascular {
namespace {

using units::mL;

/// Injects that volume at a rate, through a guide at the artery's beginning; by share against its wall.
void inject(Bench& bench, double mL_in_all, double mL_s, double against_wall) {
  bench.device.tip = {TipPlace::coronary, 0, 1};
  bench.device.tip_covered = against_wall, bench.device.injected_m3_s = mL_s * mL;
  bench.run(0, mL_in_all / mL_s);
  bench.device.injected_m3_s = 0;
}

int torn_of(int people, double mL_in_all, double mL_s, double against_wall) {
  int torn = 0;
  for (int seed = 1; seed <= people; ++seed) {
    InjuryState s;
    const InjuryModel model{.seed = static_cast<std::uint64_t>(seed)};
    for (double m3 = 0; m3 < mL_in_all * mL; m3 += mL_s * mL * 0.1)
      judge_jet(model, {0, mL_s * mL, against_wall}, 0.1, 0, s);
    torn += s.count;
  }
  return torn;
}

TEST(GuideJet, TearsAsOftenAsItsHazardSays) {
  const int people = 4000;
  const double asked = people * -std::expm1(-0.012 * 4);
  EXPECT_NEAR(torn_of(people, 4, 4, 1), asked, 4 * std::sqrt(asked));
  EXPECT_NEAR(torn_of(people, 8, 4, 0.5), asked, 4 * std::sqrt(asked)) << "twice as much, half as near";
  EXPECT_EQ(torn_of(people, 8, 2, 1), 0) << "gently";
  EXPECT_EQ(torn_of(people, 8, 4, 0), 0) << "freely";
}

Bench with_dissection(bool stent) {
  Bench bench({.stenosis = 0.1, .stent = stent});
  if (stent) bench.run(10, 6), bench.run(-1, 12);
  bench.device.balloons[0].balloon = -1;
  bench.device.provocation = {Provoked::dissection, 100, 1};
  bench.run(0, 1e-3);
  bench.device.provocation = {};
  bench.run(0, 0.1);
  return bench;
}

TEST(GuideJet, MakesADissectionRunOn) {
  Bench bench = with_dissection(false);
  const Injury& injury = bench.state.injury.injuries[0];
  ASSERT_EQ(injury.kind, InjuryKind::dissection);
  const auto narrowed_mm = [&] {
    double length_m = 0;
    for (std::size_t c = 0; c < bench.state.wall.radius_m.size(); ++c)
      if (bench.state.wall.radius_m[c] < 0.98 * bench.state.wall.rest_m[c])
        length_m += bench.physiology.flow.tree.cells[c].length_m;
    return 1e3 * length_m;
  };
  inject(bench, 4, 2, 1);
  EXPECT_EQ(injury.runs_m, 0) << "gently";
  inject(bench, 4, 4, 0);
  EXPECT_NEAR(injury.runs_m, 3e-3, 0.1e-3) << "freely, a quarter";
  const double narrow = injury.narrows;
  inject(bench, 4, 4, 1);
  EXPECT_NEAR(injury.runs_m, 15e-3, 0.1e-3);
  EXPECT_NEAR(injury.narrows, narrow + 0.24, 0.02);
  EXPECT_STREQ(grade_name(injury), "D");
  bench.run(0, 0.1);
  EXPECT_NEAR(narrowed_mm(), 2 * 5 + 15, 1.5);
  inject(bench, 12, 4, 1);
  EXPECT_STREQ(grade_name(injury), "F");

  // What lies upstream of the tip stays.
  Bench beyond = with_dissection(false);
  beyond.device.tip.cell = 150;
  beyond.device.tip.where = TipPlace::coronary, beyond.device.tip_covered = 1, beyond.device.injected_m3_s = 4 * mL;
  beyond.run(0, 1);
  EXPECT_EQ(beyond.state.injury.injuries[0].runs_m, 0);
}

TEST(GuideJet, AStentHoldsWhatIsTorn) {
  Bench bench = with_dissection(true);
  ASSERT_EQ(bench.state.stents[0].where, StentState::deployed);
  inject(bench, 8, 4, 1);
  const Injury& injury = bench.state.injury.injuries[static_cast<std::size_t>(bench.state.injury.count - 1)];
  ASSERT_EQ(injury.cell, 100);
  EXPECT_EQ(injury.runs_m, 0);
}

}  // namespace
}  // namespace ostium::vascular
