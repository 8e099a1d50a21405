// Two balloons side by side: closed forms, and a provisional stent across a fork with a kissing inflation and a
// proximal optimisation, against bench figures.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "vascular/treatment/plaque_shift.h"
#include "vascular/treatment/side_by_side.h"
#include "vascular/treatment/stent_shape.h"
#include "vascular/treatment/treatment.h"

namespace ostium::vascular {
namespace {

using units::atm, units::mL_min, units::mm, units::pi;

/// Perimeter of the convex hull of two circles, from its support function.
double hull_of_circles(double a, double b, double apart) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double f = 2 * pi * (i + 0.5) / n;
    sum += std::max(a, b + apart * std::cos(f)) * 2 * pi / n;
  }
  return sum;
}

TEST(SideBySide, IsTheHullOfTwoCirclesThatTouch) {
  for (const double b : {0.3, 0.8, 1.5}) {
    const double a = 1.5;
    EXPECT_NEAR(side_by_side(a, b, 0).lumen_m, hull_of_circles(a, b, a + b) / (2 * pi), 1e-6);
    EXPECT_NEAR(side_by_side(a, b, 0).apart_m, a + b, 1e-12);
    EXPECT_NEAR(side_by_side(a, b, 0).narrow, a / (a + b), 1e-12);
  }
}

TEST(SideBySide, OneAloneIsRound) {
  const SideBySide alone = side_by_side(1.5, 0, 0.7);
  EXPECT_EQ(alone.lumen_m, 1.5);
  EXPECT_EQ(alone.by_a, 1);
  EXPECT_EQ(alone.narrow, 1);
  EXPECT_NEAR(side_by_side(1.5, 1e-9, 0.7).lumen_m, 1.5, 1e-4);
}

TEST(SideBySide, ItsDerivativeIsThatOfItsRadius) {
  const double h = 1e-6;
  for (const double beta : {0.0, 0.4, 1.2, pi / 2})
    for (const double a : {0.5, 1.0, 1.4}) {
      const double slope = (side_by_side(a + h, 1, beta).lumen_m - side_by_side(a - h, 1, beta).lumen_m) / (2 * h);
      EXPECT_NEAR(side_by_side(a, 1, beta).by_a, slope, 1e-5) << a << " " << beta;
    }
}

/// Area of two equal ones of radius 1, flattened, by the area under their outline.
double area_of_two(double beta) {
  const double rho = pi / (pi - beta + std::sin(beta));
  const int n = 20000;
  double area = 0;
  for (int i = 0; i < n; ++i) {
    const double x = -rho * std::cos(beta) + (i + 0.5) / n * rho * (1 + std::cos(beta));
    area += 2 * std::sqrt(std::max(0.0, rho * rho - x * x)) * rho * (1 + std::cos(beta)) / n;
  }
  return 2 * area;
}

/// A wall of that tension whatever its length, near the angle.
DrawnBy drawn_with(double tension, double beta) {
  const double R = side_by_side(1, 1, beta).lumen_m;
  return {tension / R, -tension / (R * R), R};
}

TEST(SideBySide, TheirPressureDoesTheWorkOfTheWallsTension) {
  const double h = 1e-4;
  for (const double beta : {0.3, 0.8, 1.2, 1.5}) {
    const auto length = [](double angle) { return 2 * pi * side_by_side(1, 1, angle).lumen_m; };
    const double tension = (area_of_two(beta + h) - area_of_two(beta - h)) / (length(beta + h) - length(beta - h));
    EXPECT_NEAR(flattened_rad(1, 1, 2, drawn_with(2 * tension, beta)), beta, 2e-3) << beta;
    EXPECT_NEAR(flattened_rad(1, 1, 2, {0, 1e3, side_by_side(1, 1, beta).lumen_m}), beta, 2e-2) << "all but rigid";
  }
  const double rho = pi / (pi / 2 + 1);
  EXPECT_NEAR(flattened_rad(1, 1, 1, drawn_with(0.999 * rho, pi / 2)), pi / 2, 0.03) << "T = p rho: Laplace";
  EXPECT_EQ(flattened_rad(1, 1, 1, drawn_with(2 * rho, pi / 2)), pi / 2);
  EXPECT_EQ(flattened_rad(1, 1, 1, {}), 0);
}

/// Radii; of the parent's last 6 mm a share may be narrowed away.
struct Fork3 {
  double parent_m = 2.0 * mm, main_m = 1.6 * mm, side_m = 1.4 * mm, stenosis = 0, stent_m = 3.25 * mm;
};

/// A left main of 4.0 mm that forks into 3.2 and 2.8 mm, without plaque, in a phantom.
struct ForkedBench {
  FlowTree tree;
  PhysiologyModel physiology{.heart = {}, .ischaemia = {}, .flow = {}, .contrast = {}, .line = {}};
  TreatmentModel model;
  PhysiologyState blood;
  TreatmentState state;
  TreatmentInputs inputs;
  TreatmentScratch scratch;
  TreatmentReport report;
  std::vector<double> occupied_m;
  double carina_m = 0;
  enum Device { own, main_kiss, side_kiss, large, first_of_many };

  explicit ForkedBench(const Fork3& sizes = {})
      : tree(plain_tree({{-1, 40, 0.3 * mm, sizes.parent_m, Territory::lad},
                         {0, 100, 0.3 * mm, sizes.main_m, Territory::lad},
                         {0, 100, 0.3 * mm, sizes.side_m, Territory::lcx}})) {
    for (int c = 20; c < 40; ++c) tree.cells[static_cast<std::size_t>(c)].diseased_m *= 1 - sizes.stenosis;
    physiology.flow = make_flow_model(tree, 100 * mL_min);
    physiology.contrast = make_contrast_model(physiology.flow);
    PlaqueLaw phantom;
    phantom.healthy_Pa = 12 * atm;  // a silicone tube [estimate: 1 MPa, a wall of a tenth of its radius]
    model.plaque = make_plaque_model(tree, {}, phantom);
    model.balloons = {make_balloon(Compliance::semi, sizes.stent_m, 18e-3),
                      make_balloon(Compliance::non, 3.0e-3, 15e-3), make_balloon(Compliance::non, 3.0e-3, 15e-3),
                      make_balloon(Compliance::non, 4.0e-3, 8e-3)};
    for (const double wide_mm : {4.0, 4.5, 5.0, 5.5})
      model.balloons.push_back(make_balloon(Compliance::non, wide_mm * mm, 8e-3));
    model.stents = {make_stent(sizes.stent_m, 18e-3)}, model.stent_on.assign(model.balloons.size(), -1);
    model.stent_on[own] = 0;
    model.paths = all_paths(tree), model.forks = make_forks(tree);
    carina_m = model.paths[1].s_m[39] + 0.15 * mm;
    blood = make_state(physiology);
    state = make_state(model, tree);
  }
  void place(int k, Device device, int branch, double middle_m) {
    inputs.balloons[k] = {.balloon = device, .branch = branch, .shaft = {.middle_m = middle_m}};
  }
  void run(double gauge_atm, double seconds) {
    for (PlacedBalloon& placed : inputs.balloons) placed.gauge_Pa = gauge_atm * atm;
    for (int n = 0; n < 1000 * seconds; ++n)
      report = step(model, inputs, 1e-3, state, {physiology.flow, blood, occupied_m}, scratch);
  }
  void inflate(double gauge_atm) {
    run(gauge_atm, 6), run(-1, 9);
    inputs.balloons = {}, run(0, 0.05);
  }
  void stent(double gauge_atm = 12) { place(0, own, 1, carina_m + 1 * mm), inflate(gauge_atm); }
  /// The large balloon's distal marker so far beyond the carina.
  void round(double beyond_m) { place(0, large, 1, carina_m + beyond_m - 4 * mm), inflate(14); }
  void kiss() { place(0, main_kiss, 1, carina_m + 3.5 * mm), place(1, side_kiss, 2, carina_m + 3.5 * mm), inflate(10); }
  /// Share of the side branch's mouth that the carina takes.
  double obstructed() const {
    const double left = mouth_left(1.4 * mm, std::max(0.0, state.carina_m[0]));
    return 1 - left * left;
  }
  /// Radius about the side branch's middle, along the stent's wall, that no crown lies in.
  double cell_m() const {
    double least = 1;
    const StentState& s = state.stents[0];
    const Fork& fork = model.forks[0];
    const double longer = 1 / std::sqrt(1 - fork.cosine * fork.cosine);
    for (int p = 0; p < model.stents[0].points(); ++p) {
      const double x = (place_of_m(s, p) - model.paths[1].s_m[39]) / longer;
      const double y = s.radius_m[p / (2 * model.stents[0].crowns)] *
                       std::remainder(angle_of(model.stents[0], s, p) - fork.angle_rad, 2 * pi);
      least = std::min(least, std::hypot(x, y));
    }
    return least;
  }
  double middle_of(int ring) const { return ring_middle_m(model.stents[0], state.stents[0], ring); }
  /// Rings whose middle lies in the left main, short of the carina's last millimetre.
  template <class F>
  void proximal(const F& visit) const {
    for (int k = 0; k < model.stents[0].rings; ++k)
      if (middle_of(k) < carina_m - 1.5 * mm) visit(k);
  }
  /// Of the ring that lies 3 mm before the carina.
  double narrow() const {
    double out = 1;
    proximal([&](int k) {
      if (carina_m - middle_of(k) > 2.4 * mm) out = state.stents[0].narrow[k];
    });
    return out;
  }
  double area_mm2() const {
    double least = 1;
    proximal([&](int k) { least = std::min(least, area_of_ring_m2(state.stents[0], k)); });
    return 1e6 * least;
  }
  double malapposed() const {
    const std::vector<double> all = gaps(model.stents[0], state.stents[0], model.paths[1], state.wall);
    const int around = 2 * model.stents[0].crowns;
    int apart = 0, count = 0;
    proximal([&](int k) {
      for (int j = 0; j < around; ++j) apart += all[k * around + j] > 0.2 * mm, ++count;
    });
    return static_cast<double>(apart) / count;
  }
};

TEST(Kissing, LeavesAnOvalStentThatOneLargeBalloonRounds) {
  ForkedBench f;
  f.stent();
  EXPECT_EQ(f.narrow(), 1);
  const double apart = f.malapposed(), chosen_mm2 = f.area_mm2();
  EXPECT_GT(apart, 0.3) << "it was chosen for the distal vessel";
  f.kiss();
  const double oval = f.narrow();
  EXPECT_GT(oval, 0.55);
  EXPECT_LT(oval, 0.80) << "bench 0.72";
  f.round(0);
  EXPECT_GT(f.narrow(), 0.88);
  EXPECT_LT(f.malapposed(), 0.05) << "bench 33 to 0.6 %";
  EXPECT_GT(f.area_mm2(), 1.15 * chosen_mm2);
}

/// A balloon that tapers towards the daughter is squeezed out, with the rings round it: bench 0.86 +- 0.74 mm.
TEST(Kissing, EveryProximalOverexpansionLengthensTheStent) {
  ForkedBench f({.parent_m = 2.75 * mm, .stent_m = 3.5 * mm});
  f.stent(8);
  const auto length_m = [&] {
    const auto [from_m, to_m] = span_of(f.state.stents[0]);
    return to_m - from_m;
  };
  const double distal_m = span_of(f.state.stents[0]).second, stented_m = length_m();
  double before_m = stented_m;
  for (int k = 0; k < 4; ++k) {
    f.place(0, static_cast<ForkedBench::Device>(ForkedBench::first_of_many + k), 1, f.carina_m - 4 * mm);
    f.inflate(14);
    EXPECT_GT(length_m() - before_m, 0.1 * mm) << k;
    EXPECT_LT(length_m() - before_m, 1.6 * mm) << k;
    before_m = length_m();
  }
  EXPECT_GT(before_m - stented_m, 1.0 * mm) << "0.98 to 2.22 mm in patients";
  EXPECT_NEAR(span_of(f.state.stents[0]).second, distal_m, 0.1 * mm) << "its distal end is held";
}

TEST(Kissing, StretchesNoDaughterByBothBalloons) {
  ForkedBench f;
  for (VesselPath& path : f.model.paths)
    for (std::size_t k = 40; k < path.cells.size(); ++k) path.s_m[k] -= 0.29 * mm;  // it begins close to the fork
  f.place(0, ForkedBench::main_kiss, 1, f.carina_m + 3.5 * mm);
  f.place(1, ForkedBench::side_kiss, 2, f.carina_m + 3.5 * mm);
  f.run(10, 6);
  for (std::size_t c = 40; c < f.tree.cells.size(); ++c)
    EXPECT_LT(f.state.wall.peak_m[c], 1.02 * std::max(1.5 * mm, f.tree.cells[c].healthy_m)) << c;
  EXPECT_GT(f.state.wall.peak_m[37], 1.9 * mm) << "both lie in the left main";
}

TEST(Kissing, TheLargeBalloonLeavesAGapShortOfTheCarinaAndNarrowsTheBranchPastIt) {
  std::vector<double> apart, obstructed;
  for (const double beyond_mm : {-3.0, -1.0, 0.0, 3.0}) {
    ForkedBench f;
    f.stent();
    f.round(beyond_mm * mm);
    apart.push_back(f.malapposed()), obstructed.push_back(f.obstructed());
  }
  EXPECT_GT(apart[0], apart[1]);
  EXPECT_GE(apart[1], apart[2]);
  EXPECT_GT(obstructed[3], obstructed[1] + 0.1) << "bench: worst past the carina";
}

TEST(Kissing, OpensTheCellAndPushesTheCarinaBack) {
  ForkedBench f;
  f.stent();
  f.round(3 * mm);
  const double closed = f.obstructed(), cell_m = f.cell_m();
  f.kiss();
  EXPECT_LT(f.obstructed(), closed / 2);
  EXPECT_LT(cell_m, 0.6 * mm);
  EXPECT_GT(f.cell_m(), 0.85 * 1.4 * mm) << "less than the balloon's radius";
  EXPECT_LT(f.cell_m(), 1.5 * mm);
}

/// Sizes of bifurcations (Finet: 3.33, 2.70, 2.23 mm), narrowed by 60 %.
TEST(Kissing, AStentPushesPlaqueIntoTheSideBranchAndABalloonThereTakesItAway) {
  const Fork3 sizes{1.665 * mm, 1.35 * mm, 1.115 * mm, 0.6, 2.75 * mm};
  ForkedBench f(sizes);
  f.stent();
  const double in_mouth_m3 = f.state.in_mouth_m3[0], mm3 = 1e-9;
  EXPECT_GT(in_mouth_m3, 0.6 * mm3) << "finite elements: 0.89 +- 0.15 mm3";
  EXPECT_LT(in_mouth_m3, 1.2 * mm3);
  double lost_m3 = 0;
  for (std::size_t c = 140; c < 160; ++c) {
    const double r = f.blood.radius_m[c],
                 shifted = mouth_left(sizes.side_m, (1 - f.tree.s_of(static_cast<int>(c)) / mouth_m) *
                                                        std::max(0.0, f.state.carina_m[0]));
    lost_m3 += pi * (std::pow(sizes.side_m * (f.tree.s_of(static_cast<int>(c)) < mouth_m ? shifted : 1), 2) - r * r) *
               f.tree.cells[c].length_m;
  }
  EXPECT_NEAR(lost_m3, in_mouth_m3, 0.15 * in_mouth_m3);
  f.place(0, ForkedBench::side_kiss, 2, f.carina_m + 3.5 * mm);
  f.inflate(10);
  EXPECT_EQ(f.state.in_mouth_m3[0], 0) << "3.0 mm fill a branch of 2.23 mm";
}

TEST(Kissing, PushedPlaqueIsAShareOfWhatTheLumenTook) {
  ForkedBench f({.stenosis = 0.5});
  const Fork& fork = f.model.forks[0];
  const auto pushed_mm3 = [&] { return 1e9 * pushed_plaque_m3(f.tree, f.model.plaque, f.state.wall, fork); };
  EXPECT_EQ(pushed_mm3(), 0);
  for (double& peak_m : f.state.wall.peak_m) peak_m = 3.0 * mm;
  EXPECT_NEAR(pushed_mm3(), 0.08 * pi * (2.0 * 2.0 - 1.0 * 1.0) * 3, 1e-9) << "all of it, along 3 mm";
  for (double& peak_m : f.state.wall.peak_m) peak_m = std::sqrt(2.5) * mm;
  EXPECT_NEAR(pushed_mm3(), 0.08 * pi * (2.5 - 1.0) * 3, 1e-9);
  EXPECT_EQ(plaque_left_m3(f.tree, fork, 1e-9, 0), 1e-9);
  EXPECT_NEAR(plaque_left_m3(f.tree, fork, 1e-7, 1.0 * mm), pi * (1.4 * 1.4 - 1.0) * 1.5e-9, 1e-15);
}

}  // namespace
}  // namespace ostium::vascular
