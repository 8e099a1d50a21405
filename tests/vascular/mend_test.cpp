/// Known damage to our own anatomy is found and mended: the radii come back.
#include "vascular/mend/mend.h"

#include <gtest/gtest.h>

#include "tests/vascular/damage.h"
#include "tests/vascular/shapes.h"
#include "vascular/anatomy/lesion.h"
#include "vascular/box_tree.h"
#include "vascular/mend/sheets.h"
#include "vascular/mend/units.h"
#include "vascular/mend/winding.h"
#include "vascular/shape/contour.h"
#include "vascular/surface_check.h"

namespace ostium {
namespace {

constexpr double mm = 1e-3;

/// The first 80 mm of the left coronary tree: left main and LAD, circumflex, a diagonal, from an aorta 30 mm long.
class OwnAnatomy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    tubes_ = new std::vector<Tube>{
        make_tube("aorta", -1,
                  {{{-0.016, -0.02, 0}, 13 * mm}, {{-0.016, 0, 0}, 13 * mm}, {{-0.016, 0.02, 0}, 13 * mm}}),
        make_tube("LAD", 0,
                  {{{-0.01, 0, 0}, 2.2 * mm},
                   {{0.012, 0, 0.003}, 2.1 * mm},
                   {{0.03, -0.004, 0.018}, 1.7 * mm},
                   {{0.04, -0.02, 0.05}, 1.2 * mm}}),
        make_tube(
            "LCx", 1,
            {{{0.011, 0, 0.003}, 1.7 * mm}, {{0.019, -0.012, -0.006}, 1.6 * mm}, {{0.023, -0.036, -0.02}, 1.1 * mm}}),
        make_tube("D1", 1,
                  {{{0.027, -0.003, 0.015}, 1.1 * mm},
                   {{0.045, -0.015, 0.018}, 1 * mm},
                   {{0.058, -0.032, 0.028}, 0.8 * mm}})};
    (*tubes_)[0].blend = 0.8;
    whole_ = new Mesh(contour(TubeUnion(*tubes_)).mesh);
    ASSERT_TRUE(check_surface(*whole_).sound());
  }
  static void TearDownTestSuite() {
    delete tubes_;
    delete whole_;
  }

  /// Of the largest sphere about the points of the courses, between both surfaces, mm; not within `reach_m` of `p`.
  static double worst_radius_mm(const Mesh& mended, const Eigen::Vector3d& p = {1, 1, 1}, double reach_m = 0) {
    const BoxTree before(*whole_), after(mended);
    double worst = 0;
    for (const Tube& tube : *tubes_)
      for (std::size_t i = 0; i < tube.nodes.size(); i += 3) {
        const TubeNode& node = tube.nodes[i];
        if ((node.p - p).norm() < reach_m) continue;
        worst = std::max(worst, std::fabs(before.nearest(node.p, 1).distance_m - after.nearest(node.p, 1).distance_m));
      }
    return worst / mm;
  }

  static const MendNote* note(const Mended& mended, const std::string& words) {
    for (const MendNote& n : mended.notes)
      if (n.what.find(words) != std::string::npos) return &n;
    return nullptr;
  }

  static std::string words(const Mended& mended) {
    std::string all;
    for (const MendNote& n : mended.notes) all += std::to_string(n.count) + " " + n.what + "\n";
    return all;
  }

  static void expect_one_sound_lumen(const Mended& mended) {
    EXPECT_EQ(mended.lumens, 1) << words(mended);
    const SurfaceReport report = check_surface(mended.lumen);
    EXPECT_TRUE(report.sound()) << describe(report);
    EXPECT_EQ(report.components, 1);
  }

  static std::vector<Tube>* tubes_;
  static Mesh* whole_;
};
std::vector<Tube>* OwnAnatomy::tubes_ = nullptr;
Mesh* OwnAnatomy::whole_ = nullptr;

TEST_F(OwnAnatomy, WhatIsSoundKeepsItsCalibre) {
  const Mended mended = mend(*whole_);
  expect_one_sound_lumen(mended);
  EXPECT_TRUE(mended.notes.empty()) << mended.notes[0].what;
  EXPECT_LT(worst_radius_mm(mended.lumen), 0.1);
}

TEST_F(OwnAnatomy, GapsAreBridgedEndToEnd) {
  const Tube& lad = (*tubes_)[1];
  const double s = lad.length_m() - 20 * mm;
  const Mended mended = mend(test::with_gap(*whole_, lad.at(s).p, lad.tangent(s), 3 * mm, 4 * mm));
  expect_one_sound_lumen(mended);
  ASSERT_TRUE(note(mended, "end joined to the end"));
  EXPECT_EQ(note(mended, "end joined to the end")->count, 1);
  EXPECT_LT((note(mended, "end joined to the end")->where[0] - lad.at(s).p).norm(), 1 * mm);
  EXPECT_LT(worst_radius_mm(mended.lumen), 0.15);
}

TEST_F(OwnAnatomy, GapsAreBridgedEndToWall) {
  // Where the diagonal leaves: 3 mm of it are missing, and the wall that it leaves has a hole.
  const Tube& d1 = (*tubes_)[3];
  const double s = 3.4 * mm;
  const Mended mended = mend(test::with_gap(*whole_, d1.at(s).p, d1.tangent(s), 3 * mm, 3 * mm));
  expect_one_sound_lumen(mended);
  EXPECT_LT(worst_radius_mm(mended.lumen, d1.at(s).p, 5 * mm), 0.15);
  ASSERT_TRUE(note(mended, "gap bridged, end to wall")) << words(mended);
  EXPECT_LT((note(mended, "gap bridged, end to wall")->where[0] - d1.at(s).p).norm(), 3 * mm);
}

TEST_F(OwnAnatomy, SideBySideIsNoGap) {
  std::vector<Tube> two = {
      make_tube("a", -1, {{{0, 0, 0}, 2 * mm}, {{0.03, 0, 0}, 1.8 * mm}, {{0.06, 0, 0}, 1.6 * mm}}),
      make_tube("b", -1, {{{0.0, 0.0055, 0}, 2 * mm}, {{0.03, 0.0055, 0}, 1.8 * mm}, {{0.06, 0.0055, 0}, 1.6 * mm}})};
  two[1].blend = 0.01;
  const Mended mended = mend(contour(TubeUnion(two)).mesh);
  EXPECT_EQ(mended.lumens, 2);
  EXPECT_FALSE(note(mended, "gap bridged"));
}

TEST_F(OwnAnatomy, PinholesAndFlippedPatches) {
  Mesh mesh = test::with_pinholes(*whole_, 97);
  const int missing = static_cast<int>(whole_->triangles.size() - mesh.triangles.size());
  mesh = test::with_flipped_patch(mesh, {0.03, -0.004, 0.018}, 4 * mm);
  const Mended mended = mend(mesh);
  expect_one_sound_lumen(mended);
  ASSERT_TRUE(note(mended, "pinhole closed"));
  EXPECT_NEAR(note(mended, "pinhole closed")->count, missing, 0.05 * missing);
  ASSERT_TRUE(note(mended, "faced another way"));
  EXPECT_GT(note(mended, "faced another way")->count, 20);
  EXPECT_LT(worst_radius_mm(mended.lumen), 0.15);
}

TEST_F(OwnAnatomy, DoubledWallLosesTheOuterOne) {
  const Mended mended = mend(test::with_outer_wall(*whole_, 0.7 * mm));
  expect_one_sound_lumen(mended);
  ASSERT_TRUE(note(mended, "outer wall dropped (0.")) << words(mended);
  EXPECT_LT(worst_radius_mm(mended.lumen), 0.15);
}

TEST_F(OwnAnatomy, NoiseIsSmoothed) {
  const Mended mended = mend(test::with_noise(*whole_, 0.2 * mm, 7));
  expect_one_sound_lumen(mended);
  EXPECT_TRUE(note(mended, "rough surface smoothed"));
  EXPECT_LT(worst_radius_mm(mended.lumen), 0.15);
}

TEST_F(OwnAnatomy, InsideOutIsTurned) {
  Mesh mesh = *whole_;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const Mended mended = mend(mesh);
  expect_one_sound_lumen(mended);
  ASSERT_TRUE(note(mended, "faced inwards"));
  EXPECT_LT(worst_radius_mm(mended.lumen), 0.1);
}

TEST_F(OwnAnatomy, StenosisOfThreeQuartersSurvives) {
  std::vector<Tube> tubes = *tubes_;
  Tube& lad = tubes[1];
  const double middle = lad.length_m() - 25 * mm, healthy = lad.at(middle).radius_m;
  for (TubeNode& node : lad.nodes)
    if (const double x = std::fabs(node.s_m - middle); x < 6 * mm)
      node.radius_m *= x < 3 * mm ? 0.25 : 0.25 + 0.75 * (x - 3 * mm) / (3 * mm);
  const Mended mended = mend(contour(TubeUnion(tubes)).mesh);
  expect_one_sound_lumen(mended);
  const double radius = BoxTree(mended.lumen).nearest(lad.at(middle).p, 1).distance_m;
  EXPECT_NEAR(100 * (1 - radius / healthy), 75, 5);
}

TEST_F(OwnAnatomy, UnitsAreTold) {
  const std::vector<Tube> course = {make_tube("aorta", -1,
                                              {{{0, 0, 0}, 15 * mm},
                                               {{-0.02, 0.1, 0}, 14 * mm},
                                               {{0.05, 0.1, -0.03}, 13 * mm},
                                               {{0.05, -0.3, -0.03}, 8 * mm}})};
  const Mesh aorta = contour(TubeUnion(course), {.cell_at_1_mm_m = 2 * mm, .finest_m = 2 * mm, .relaxations = 0}).mesh;
  for (const Mesh* mesh : {&aorta, static_cast<const Mesh*>(whole_)})
    for (LengthUnit unit : {LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::inch}) {
      const UnitGuess guess = guess_unit(test::scaled(*mesh, 1 / metres(unit)));
      EXPECT_EQ(name_of(guess.unit), name_of(unit));
      EXPECT_TRUE(guess.vessel);
    }
}

TEST(Mend, WhatHoldsNothingIsRefused) {
  EXPECT_THROW(mend({{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}}), MeshError);
}

TEST(Winding, CountsSurfacesAroundAPoint) {
  Mesh two = test::sphere(0.01, 24);
  append(two, test::sphere(0.01, 24, {0.012, 0, 0}));
  const WindingNumber winding(two);
  EXPECT_NEAR(winding.at({-0.005, 0, 0}), 1, 0.02);
  EXPECT_NEAR(winding.at({0.006, 0, 0}), 2, 0.02);
  EXPECT_NEAR(winding.at({0, 0.03, 0}), 0, 0.02);
}

TEST(Sheets, OpeningsHaveTheirSizeAndSide) {
  // A cube without its lid: 4 edges of the top face are open.
  Mesh open = test::cube(0.01);
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // z = 1
  Sheets sheets = sheets_of(open);
  orient(open, sheets);
  const auto openings = openings_of(open, sheets);
  ASSERT_EQ(openings.size(), 1u);
  EXPECT_EQ(openings[0].half_edges.size(), 4u);
  EXPECT_NEAR(openings[0].diameter_m, 2 * 0.01 / std::sqrt(3.14159265), 1e-9);
  EXPECT_NEAR(openings[0].outwards.z(), 1, 1e-9);
  cap(open, openings[0]);
  EXPECT_NEAR(volume_m3(open), 1e-6, 1e-12);
  EXPECT_TRUE(check_surface(open).closed());
}

}  // namespace
}  // namespace ostium
