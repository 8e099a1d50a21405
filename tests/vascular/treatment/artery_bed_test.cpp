/// Arteries that give way, against beams on an elastic bed; a tube under pressure, against its closed form.
#include "vascular/treatment/artery_bed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/units.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"

namespace ostium::vascular {
namespace {

using Eigen::Vector3d;
using units::pi;

constexpr double cell_m = 0.7e-3;

struct Arteries {
  FlowTree tree;
  ArteryBedModel model;
  ArteryBedState state;
  ArteryBedScratch scratch;
  std::vector<Vector3d> load_N;
  std::vector<BedTube> tubes;

  explicit Arteries(const std::vector<PlainBranch>& branches, const ArteryBedLaw& law = {})
      : tree(plain_tree(branches)),
        model(make_artery_bed(tree, layout_of(tree), law)),
        load_N(tree.cells.size(), Vector3d::Zero()) {
    state.aside_P.assign(tree.cells.size(), Vector3d::Zero());
  }
  void run(double for_s, double dt_s = 8e-3) {
    for (double t = 0; t < for_s; t += dt_s) step(model, {load_N, tubes}, dt_s, state, scratch);
  }
  /// Until it rests.
  void settle() {
    for (int i = 0; i < 12; ++i) step(model, {load_N, tubes}, 1e6, state, scratch);
  }
};

TEST(ArteryBed, GivesWayAsABeamOnAnElasticBed) {
  Arteries one({{-1, 300, cell_m, 1.5e-3}});
  const double k = one.model.law.bed_N_m2, EI = one.model.EI_N_m2[150], P = 0.05;
  // A single force: deepest by P l / (2 k), and (cos + sin) e^- on either side (Hetenyi 1946).
  one.load_N[150] = Vector3d(0, P, 0);
  one.settle();
  const double l = std::pow(k / (4 * EI), 0.25), deepest = P * l / (2 * k);
  EXPECT_NEAR(one.state.aside_P[150].y(), deepest, 0.01 * deepest);
  for (const int away : {3, 6, 12}) {
    const double x = l * away * cell_m, want = deepest * std::exp(-x) * (std::cos(x) + std::sin(x));
    EXPECT_NEAR(one.state.aside_P[static_cast<std::size_t>(150 + away)].y(), want, 0.02 * deepest) << away;
    EXPECT_NEAR(one.state.aside_P[static_cast<std::size_t>(150 - away)].y(), want, 0.02 * deepest) << away;
  }
  EXPECT_LT(std::fabs(one.state.aside_P[150].x()) + std::fabs(one.state.aside_P[150].z()), 1e-12);
  // A load all along: f / k, except at the origin, which stays.
  for (Vector3d& load : one.load_N) load = Vector3d(0, 0, 5 * cell_m);
  one.settle();
  EXPECT_NEAR(one.state.aside_P[150].z(), 5 / k, 1e-3 * 5 / k);
  EXPECT_EQ(one.state.aside_P[0].z(), 0);
}

TEST(ArteryBed, TurnsNoMoreThanItsLumenBears) {
  // What folded a left main: a guide that was drawn with 10 N, on cells that lie beside one that stays where it is.
  Arteries one({{-1, 300, cell_m, 1.5e-3}});
  for (const std::size_t pulled : {1UL, 3UL, 150UL}) one.load_N[pulled] = Vector3d(0, 10, 0);
  for (const double for_s : {0.1, 10.0}) {
    one.run(for_s);
    const std::vector<Vector3d>& z = one.state.aside_P;
    double steepest = 0, most_m = 0;
    for (std::size_t c = 1; c < z.size(); ++c)
      steepest = std::max(steepest, (z[c] - z[c - 1]).norm() / cell_m), most_m = std::max(most_m, z[c].norm());
    EXPECT_NEAR(steepest, one.model.law.steepest, 1e-9);
    EXPECT_LE(most_m, one.model.law.most_aside_m * (1 + 1e-9));
    EXPECT_GT(most_m, 1e-3);
  }
}

TEST(ArteryBed, ComesBackWithItsTime) {
  Arteries one({{-1, 300, cell_m, 1.5e-3}});
  const double k = one.model.law.bed_N_m2, T = one.model.law.yields_s;
  for (Vector3d& load : one.load_N) load = Vector3d(0, 0, 5 * cell_m);
  one.run(T, T / 200);
  EXPECT_NEAR(one.state.aside_P[150].z(), (1 - std::exp(-1)) * 5 / k, 0.01 * 5 / k);
  one.settle();
  for (Vector3d& load : one.load_N) load.setZero();
  one.run(2 * T, T / 200);
  EXPECT_NEAR(one.state.aside_P[150].z(), std::exp(-2) * 5 / k, 0.01 * 5 / k);
}

TEST(ArteryBed, ASideBranchGoesWithItsParentAndPullsAsMuchAsItIsPulled) {
  Arteries tree({{-1, 100, cell_m, 1.5e-3}, {0, 60, cell_m, 1.2e-3}, {0, 60, cell_m, 1e-3}});
  const std::size_t trunk = 97, side = static_cast<std::size_t>(tree.tree.branches[2].first + 4);
  tree.load_N[trunk] = Vector3d(0, 0.02, 0);
  tree.settle();
  const double there = tree.state.aside_P[side].y();
  EXPECT_GT(there, 0.2 * tree.state.aside_P[trunk].y());
  tree.load_N[trunk].setZero();
  tree.load_N[side] = Vector3d(0, 0.02, 0);
  tree.settle();
  EXPECT_NEAR(tree.state.aside_P[trunk].y(), there, 1e-9 * there) << "Maxwell and Betti";
}

TEST(ArteryBed, ABalloonStraightensABend) {
  // A wave of curvature: every term of the equation is the same wave.
  Arteries one({{-1, 400, cell_m, 1.5e-3}});
  const double k = one.model.law.bed_N_m2, EI = one.model.EI_N_m2[200], q = 2 * pi / (40 * cell_m), y0 = 0.5e-3,
               B = 5e-5;
  const auto wave = [&](std::size_t cell) { return std::sin(q * cell_m * static_cast<double>(cell)); };
  for (int cell = 2; cell < 400; ++cell)
    one.tubes.push_back({cell, {B, 1e3}, Vector3d(0, -q * q * y0 * wave(static_cast<std::size_t>(cell - 1)), 0)});
  one.settle();
  const double share = B * std::pow(q, 4) / ((B + EI) * std::pow(q, 4) + k);
  for (const std::size_t cell : {190u, 200u, 210u})
    EXPECT_NEAR(one.state.aside_P[cell].y(), -share * y0 * wave(cell), 0.02 * share * y0) << cell;
  EXPECT_GT(share, 0.6) << "a test that straightens";
}

TEST(ArteryBed, NeverGoesFartherThanItMay) {
  Arteries one({{-1, 100, cell_m, 1.5e-3}});
  for (std::size_t cell = 30; cell < 70; ++cell) one.load_N[cell] = Vector3d(5, 0, 0);
  one.settle();
  EXPECT_NEAR(one.state.aside_P[50].norm(), one.model.law.most_aside_m, 1e-9);
}

/// A straight wire in a wavy artery, whose wall lies aside as the bed lets it. It touches the inner side of each crest:
/// loads P, alternating every half wave, on both of them. Of wire and artery each, the deflection at a crest is
///   4 P / L times the sum of 1 / (EI (n q)^4 + bed) over the odd n,
/// and both together are the height of the wave less the room that the wire has.
class WireInAWavyArtery {
 public:
  static constexpr int cells = 400, around = 24;
  static constexpr double wave_m = 40 * cell_m, high_m = 1.2e-3, wire_m = 0.45e-3, lumen_m = 0.75e-3;
  static constexpr double q = 2 * pi / wave_m;

  explicit WireInAWavyArtery(double E_Pa) : artery_({{-1, cells, cell_m, lumen_m}}) {
    core::RodDescription d = core::steel_wire({.elements = 260, .E_Pa = E_Pa, .length_m = (cells - 20) * cell_m});
    d.damping.drag_across_N_s_m2 = 1;
    EI_N_m2 = d.sections[0].EI1_N_m2;
    const core::SurfaceDescription wall = artery_wall();
    surface_ = std::make_shared<core::Surface>(make_surface(wall));
    editor_.emplace(wall, *surface_);
    editor_->let_yield();
    for (const Vector3d& p : wall.frames[0]) at_m_.push_back(p.x());
    core::Model model;
    model.rods = {make_rod(d)}, model.surfaces = {surface_}, model.gravity_W.setZero();
    wire_.emplace(std::move(model), core::along_x());
    wire_->inputs.surfaces.resize(1);
  }

  /// The artery is bent into its shape within 0.3 s; then both settle.
  void run(double for_s) {
    const auto bent = [](int n) { return std::min(1.0, n / 300.0); };
    for (int n = 0; n < 1000 * for_s; ++n) {
      wire_->inputs.surfaces[0].sway_before = bent(n), wire_->inputs.surfaces[0].sway_after = bent(n + 1);
      wire_->step();
      if (n % 8 == 0) give_way();
    }
  }

  /// How far the crests in the middle are straightened, on the mean.
  double straightened_m() const {
    double sum = 0;
    for (int crest = 8; crest < 12; ++crest) {
      const double outwards = crest % 2 ? -1 : 1;
      sum -= outwards * artery_.state.aside_P[static_cast<std::size_t>(20 * crest + 10)].y() / 4;
    }
    return sum;
  }
  double expected_m() const {
    const double room_m = lumen_m - wire_m / std::cos(pi / around);  // in a groove of the tube
    double of_wire = 0, of_artery = 0;
    for (int n = 1; n < 400; n += 2) {
      const double q4 = std::pow(n * q, 4);
      of_wire += 1 / (EI_N_m2 * q4), of_artery += 1 / (artery_.model.EI_N_m2[200] * q4 + artery_.model.law.bed_N_m2);
    }
    return (high_m - room_m) * of_artery / (of_wire + of_artery);
  }
  double EI_N_m2 = 0;

 private:
  /// It waves in the middle, and is straight at its ends.
  static double wave(double x_m) {
    const double from_end_m = std::min(x_m, cells * cell_m - x_m),
                 grown = std::clamp((from_end_m - wave_m) / wave_m, 0.0, 1.0);
    return grown * grown * (3 - 2 * grown) * high_m * std::sin(q * x_m);
  }

  core::SurfaceDescription artery_wall() const {
    std::vector<core::TubePoint> points;
    for (int c = -2; c <= cells; ++c) points.push_back({Vector3d(c * cell_m, 0, 0), lumen_m});
    core::SurfaceDescription wall = core::tube(points, around);
    for (const Vector3d& p : wall.frames[0]) wall.sway.emplace_back(0, wave(p.x()), 0);
    return wall;
  }

  void give_way() {
    for (Vector3d& load : artery_.load_N) load.setZero();
    for (const core::Touch& touch : wire_->report.touches)
      artery_.load_N[static_cast<std::size_t>(std::clamp<long>(std::lround(touch.p_W.x() / cell_m), 0, cells - 1))] -=
          touch.normal_W_N;
    artery_.run(8e-3);
    const std::vector<Vector3d>& z = artery_.state.aside_P;
    for (std::size_t v = 0; v < at_m_.size(); ++v) {
      const double at = std::clamp(at_m_[v] / cell_m, 0.0, cells - 1.001);
      const auto c = static_cast<std::size_t>(at);
      editor_->put_aside(static_cast<int>(v), z[c] + (at - static_cast<double>(c)) * (z[c + 1] - z[c]));
    }
    editor_->refit_aside();
  }

  Arteries artery_;
  std::optional<core::Bench> wire_;
  std::shared_ptr<core::Surface> surface_;
  std::optional<core::SurfaceEditor> editor_;
  std::vector<double> at_m_;
};

TEST(ArteryBed, AWireStraightensAnArtery) {
  for (const double E_Pa : {0.3e9, 1e9}) {
    WireInAWavyArtery one(E_Pa);
    one.run(2);
    EXPECT_NEAR(one.straightened_m(), one.expected_m(), 0.05 * one.expected_m()) << one.EI_N_m2;
  }
}

TEST(PressurisedTube, WrinklesAndReachesItsLargestMoment) {
  const double r = 1.5e-3, p = 10 * 101325, stretch = 1e4;
  const PressurisedTube tube = pressurised_tube(r, p, stretch);
  EXPECT_NEAR(tube.EI_N_m2, pi * r * r * r * stretch, 1e-12);
  EXPECT_NEAR(tube.most_Nm, pi * r * r * r * p, 1e-9);
  const auto at = [&](double x) { return moment_Nm(tube, x * tube.most_Nm / tube.EI_N_m2) / tube.most_Nm; };
  EXPECT_NEAR(at(0.3), 0.3, 1e-12);
  EXPECT_NEAR(at(0.5 + 1e-6), 0.5, 1e-4) << "wrinkles begin at half of it, without a jump";
  EXPECT_NEAR(at(pi / 2), pi / 4, 1e-6) << "half round";
  EXPECT_LT(at(50), 1);
  EXPECT_GT(at(50), 0.97);
  double before = 0;
  for (double x = 0.05; x < 20; x += 0.05) {
    EXPECT_GT(at(x), before);
    before = at(x);
  }
  EXPECT_EQ(moment_Nm(pressurised_tube(r, -1, stretch), 10), 0);
}

}  // namespace
}  // namespace ostium::vascular
