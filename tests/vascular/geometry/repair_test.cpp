/// Known damage to our own anatomy is found and repaired: radii are restored.
#include "vascular/geometry/repair/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tests/vascular/geometry/bent_tube.h"
#include "tests/vascular/geometry/damage.h"
#include "tests/vascular/geometry/shapes.h"
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/remesh/decimate.h"
#include "vascular/geometry/repair/bridges.h"
#include "vascular/geometry/repair/double_wall.h"
#include "vascular/geometry/repair/sheets.h"
#include "vascular/geometry/repair/units.h"

namespace ostium::vascular {
namespace {

using units::mm;

/// The lumen that is stored, of some 20 triangles around, holds as much as the smooth one.
TEST(Repair, ATubeKeepsItsCalibre) {
  for (double diameter : {1.5 * mm, 3 * mm, 5 * mm}) {
    const double length = 12 * diameter;
    const Mesh tube = test::tube(diameter / 2, length, 96, 200);
    const RepairedMesh repaired = repair_mesh(tube);
    const double whole = volume_m3(tube), stored = volume_m3(repaired.lumen);
    EXPECT_NEAR(std::sqrt(stored / whole) * diameter, diameter, std::min(0.05 * mm, 0.03 * diameter))
        << diameter / mm << " mm wide";
  }
}

bool says(const RepairedMesh& repaired, const char* words) {
  return std::ranges::any_of(repaired.notes, [&](const RepairNote& n) { return n.what.starts_with(words); });
}

/// A tube and another beside it, so far away.
Mesh two(const Mesh& one, double apart) {
  Mesh both = one;
  const auto count = static_cast<int>(one.vertices.size());
  for (const Eigen::Vector3d& p : one.vertices) both.vertices.push_back(p + Eigen::Vector3d(apart, 0, -1 * mm));
  for (const auto& [a, b, c] : one.triangles) both.triangles.push_back({a + count, b + count, c + count});
  return both;
}

/// Also where the first corner of one lies within the other.
TEST(Repair, TubesThatTouchOrCrossAreJoinedAndItIsSaid) {
  for (const double apart : {3.9 * mm, 4 * mm, 4.1 * mm}) {
    const RepairedMesh repaired = repair_mesh(two(test::tube(2 * mm, 30 * mm, 32, 20), apart));
    EXPECT_EQ(repaired.lumens, 1);
    EXPECT_TRUE(says(repaired, "piece joined to another")) << apart / mm;
  }
}

TEST(Repair, TubesThatNearlyTouchDoNotCross) {
  const RepairedMesh repaired = repair_mesh(two(test::tube(1.5 * mm, 60 * mm, 64, 120), 3.15 * mm));
  EXPECT_EQ(repaired.lumens, 2);
  EXPECT_EQ(check_surface(repaired.lumen).crossings.count, 0);
}

/// A straight vessel, 3 mm wide, narrowed over 12 mm in its middle.
Mesh narrowed(double stenosis, double length_m) {
  Mesh tube = test::tube(1.5 * mm, length_m, 64, static_cast<int>(length_m / (0.5 * mm)));
  for (Eigen::Vector3d& p : tube.vertices) {
    const double x = std::min(1.0, std::fabs(p.z() - length_m / 2) / (6 * mm));
    const double left = 1 - stenosis * 0.5 * (1 + std::cos(units::pi * x));
    p.x() = left * p.x() + 0.4 * p.z(), p.y() = left * p.y() + 0.3 * p.z();  // no grid has nodes all along it
  }
  return tube;
}

TEST(Repair, ANarrowingFinerThanTheFinestGridCutsAndItIsSaid) {
  const RepairedMesh repaired = repair_mesh(narrowed(0.99, 60 * mm));
  EXPECT_EQ(repaired.lumens, 2);
  EXPECT_EQ(repaired.voxel_m, repaired.finest_m);
  EXPECT_TRUE(says(repaired, "vessel cut in two"));
}

/// As small a share of a long vessel that its first grid is coarser than the throat.
TEST(Repair, AVesselThatTheGridCutsIsFilledOnAFinerOne) {
  const Mesh tube = narrowed(0.9, 300 * mm);
  const RepairedMesh coarse = repair_mesh(tube, {.voxel_m = 0.4 * mm});
  EXPECT_EQ(coarse.lumens, 2);
  EXPECT_TRUE(says(coarse, "vessel cut in two"));
  const RepairedMesh repaired = repair_mesh(tube);
  EXPECT_EQ(repaired.lumens, 1);
  EXPECT_FALSE(says(repaired, "vessel cut in two"));
}

TEST(Repair, AThroatThatIsKnownMakesTheGridFiner) {
  const Mesh tube = narrowed(0.7, 300 * mm);
  const RepairedMesh coarse = repair_mesh(tube), fine = repair_mesh(tube, {.narrowest_m = 0.9 * mm});
  EXPECT_GT(coarse.voxel_m, 0.3 * mm);
  EXPECT_NEAR(fine.voxel_m, 0.9 * mm / voxels_across, 1e-9);
}

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

  /// Largest difference of inscribed radii along the courses between both surfaces, mm; excluding points within
  /// `reach_m` of `p`.
  static double worst_radius_mm(const Mesh& repaired, const Eigen::Vector3d& p = {1, 1, 1}, double reach_m = 0) {
    const BoundingVolumeHierarchy before(*whole_), after(repaired);
    double worst = 0;
    for (const Tube& tube : *tubes_)
      for (std::size_t i = 0; i < tube.nodes.size(); i += 3) {
        const TubeNode& node = tube.nodes[i];
        if ((node.p - p).norm() < reach_m) continue;
        worst = std::max(worst, std::fabs(before.nearest(node.p, 1).distance_m - after.nearest(node.p, 1).distance_m));
      }
    return worst / mm;
  }

  static const RepairNote* note(const RepairedMesh& repaired, const std::string& words) {
    for (const RepairNote& n : repaired.notes)
      if (n.what.find(words) != std::string::npos) return &n;
    return nullptr;
  }

  static std::string words(const RepairedMesh& repaired) {
    std::string all;
    for (const RepairNote& n : repaired.notes) all += std::to_string(n.count) + " " + n.what + "\n";
    return all;
  }

  static void expect_one_sound_lumen(const RepairedMesh& repaired) {
    EXPECT_EQ(repaired.lumens, 1) << words(repaired);
    const SurfaceReport report = check_surface(repaired.lumen);
    EXPECT_TRUE(report.sound()) << describe(report);
    EXPECT_EQ(report.components, 1);
  }

  static std::vector<Tube>* tubes_;
  static Mesh* whole_;
};
std::vector<Tube>* OwnAnatomy::tubes_ = nullptr;
Mesh* OwnAnatomy::whole_ = nullptr;

TEST_F(OwnAnatomy, WhatIsSoundKeepsItsCalibre) {
  const RepairedMesh repaired = repair_mesh(*whole_);
  expect_one_sound_lumen(repaired);
  EXPECT_TRUE(repaired.notes.empty()) << repaired.notes[0].what;
  EXPECT_LT(worst_radius_mm(repaired.lumen), 0.1);
}

TEST_F(OwnAnatomy, GapsAreBridgedEndToEnd) {
  const Tube& lad = (*tubes_)[1];
  const double s = lad.length_m() - 20 * mm;
  const RepairedMesh repaired = repair_mesh(test::with_gap(*whole_, lad.at(s).p, lad.tangent(s), 3 * mm, 4 * mm));
  expect_one_sound_lumen(repaired);
  ASSERT_TRUE(note(repaired, "end joined to the end"));
  EXPECT_EQ(note(repaired, "end joined to the end")->count, 1);
  EXPECT_LT((note(repaired, "end joined to the end")->where[0] - lad.at(s).p).norm(), 1 * mm);
  EXPECT_LT(worst_radius_mm(repaired.lumen), 0.15);
}

TEST_F(OwnAnatomy, GapsAreBridgedEndToWall) {
  // At the diagonal's origin: 3 mm of it are missing, and its parent's wall has a hole.
  const Tube& d1 = (*tubes_)[3];
  const double s = 3.4 * mm;
  const RepairedMesh repaired = repair_mesh(test::with_gap(*whole_, d1.at(s).p, d1.tangent(s), 3 * mm, 3 * mm));
  expect_one_sound_lumen(repaired);
  EXPECT_LT(worst_radius_mm(repaired.lumen, d1.at(s).p, 5 * mm), 0.15);
  ASSERT_TRUE(note(repaired, "gap bridged, end to wall")) << words(repaired);
  EXPECT_LT((note(repaired, "gap bridged, end to wall")->where[0] - d1.at(s).p).norm(), 3 * mm);
}

TEST_F(OwnAnatomy, SideBySideIsNoGap) {
  std::vector<Tube> two = {
      make_tube("a", -1, {{{0, 0, 0}, 2 * mm}, {{0.03, 0, 0}, 1.8 * mm}, {{0.06, 0, 0}, 1.6 * mm}}),
      make_tube("b", -1, {{{0.0, 0.0055, 0}, 2 * mm}, {{0.03, 0.0055, 0}, 1.8 * mm}, {{0.06, 0.0055, 0}, 1.6 * mm}})};
  two[1].blend = 0.01;
  const RepairedMesh repaired = repair_mesh(contour(TubeUnion(two)).mesh);
  EXPECT_EQ(repaired.lumens, 2);
  EXPECT_FALSE(note(repaired, "gap bridged"));
}

TEST(Repair, AShelfBetweenPiecesBecomesATaper) {
  // A vessel of 8 mm radius whose second half was drawn by its outer wall, 2.5 mm farther out.
  const std::vector<Tube> tube = {
      make_tube("aorta", -1, {{{0, 0, 0}, 8 * mm}, {{0.06, 0, 0}, 8 * mm}, {{0.12, 0, 0}, 8 * mm}})};
  const Mesh whole = contour(TubeUnion(tube)).mesh;
  const Eigen::Vector3d p(0.06, 0, 0), along(1, 0, 0);
  const RepairedMesh repaired = repair_mesh(test::with_step(whole, p, along, 2.5 * mm));
  EXPECT_EQ(repaired.lumens, 1);
  EXPECT_TRUE(check_surface(repaired.lumen).sound());
  const auto note = std::find_if(repaired.notes.begin(), repaired.notes.end(),
                                 [](const RepairNote& n) { return n.what.find("made a taper") != std::string::npos; });
  ASSERT_NE(note, repaired.notes.end());
  EXPECT_EQ(note->count, 1);
  EXPECT_LT((note->where[0] - p).norm(), 2 * mm);
  const BoundingVolumeHierarchy tree(repaired.lumen);
  const auto radius = [&](double x) {
    double sum = 0;  // by rays: the distance to the nearest wall would not show a shelf
    constexpr int rays = 24;
    for (int k = 0; k < rays; ++k) {
      const double angle = 2 * 3.14159265358979 * k / rays;
      const auto hits = tree.hits({x, 0, 0}, Eigen::Vector3d(0, std::cos(angle), std::sin(angle)), 0.03);
      EXPECT_EQ(hits.size(), 1u) << "an inner wall at " << x;
      if (!hits.empty()) sum += hits[0].distance_m / rays;
    }
    return sum;
  };
  // The narrower piece is unchanged, and the wider one beyond 20 mm (eight steps); in between it rises gently.
  for (double x = 0.02; x < 0.0575; x += 2 * mm) EXPECT_NEAR(radius(x), 8 * mm, 0.1 * mm) << x;
  for (double x = 0.084; x < 0.1; x += 2 * mm) EXPECT_NEAR(radius(x), 10.5 * mm, 0.1 * mm) << x;
  double steepest = 0;
  for (double x = 0.056; x < 0.084; x += 1 * mm)
    steepest = std::max(steepest, (radius(x + 2 * mm) - radius(x)) / (2 * mm));
  EXPECT_LT(steepest, std::tan(16 * 3.14159265358979 / 180));
}

TEST(Repair, AnAortaCutAboveItsRootIsCarriedOn) {
  // An aorta that ends at x = 0; an artery begins 6 mm beyond, outside the position of the missing wall.
  const std::vector<Tube> aorta = {
      make_tube("aorta", -1, {{{-0.02, 0, 0}, 10 * mm}, {{0.03, 0, 0}, 10 * mm}, {{0.08, 0, 0}, 10 * mm}})};
  const std::vector<Tube> artery = {make_tube(
      "RCA", -1, {{{-0.006, 0.0125, 0}, 1.8 * mm}, {{-0.006, 0.03, 0}, 1.6 * mm}, {{0.004, 0.05, 0}, 1.4 * mm}})};
  Mesh mesh = contour(TubeUnion(aorta)).mesh;
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) { return test::middle_of(mesh, t).x() < 0; });
  append(mesh, contour(TubeUnion(artery)).mesh);
  RepairOptions coarse;
  coarse.voxel_m = 0.5 * mm;
  const RepairedMesh repaired = repair_mesh(mesh, coarse);
  EXPECT_EQ(repaired.lumens, 1);
  EXPECT_TRUE(check_surface(repaired.lumen).sound());
  std::string all;
  for (const RepairNote& n : repaired.notes) all += n.what + "\n";
  EXPECT_NE(all.find("carried on"), std::string::npos) << all;
  const BoundingVolumeHierarchy tree(repaired.lumen);
  // As wide as at the cut, and extended past the ostium by the distance from ostium to valve.
  for (double x = -0.016; x < 0.06; x += 4 * mm) {
    if (std::fabs(x + 0.006) < 4 * mm) continue;
    const auto hits = tree.hits({x, 0, 0}, Eigen::Vector3d::UnitY(), 0.03);
    ASSERT_EQ(hits.size(), 1u) << x;
    EXPECT_NEAR(hits[0].distance_m, 10 * mm, 0.15 * mm) << x;
  }
  const auto end = tree.hits({0.02, 0, 0}, -Eigen::Vector3d::UnitX(), 0.1);
  ASSERT_EQ(end.size(), 1u);
  EXPECT_NEAR(0.02 - end[0].distance_m, -0.018, 1 * mm);
}

TEST(Repair, BridgesBendAndDoNotKink) {
  // A quarter circle: leaves along x, arrives along y.
  const Bridge bridge{
      .p_from = {0, 0, 0}, .p_to = {0.01, 0.01, 0}, .radius_m = 1 * mm, .leaving = {1, 0, 0}, .arriving = {0, 1, 0}};
  const Mesh tube = body_of(bridge, 1 * mm);
  EXPECT_TRUE(check_surface(tube).sound());
  const double length = 10 * mm * 3.14159265358979 / 2 + 2 * mm;
  EXPECT_NEAR(volume_m3(tube), 3.14159265358979 * 1e-6 * length, 0.05 * 3.14159265358979 * 1e-6 * length);
  const BoundingVolumeHierarchy tree(tube);
  for (double angle : {0.3, 0.8, 1.3}) {
    const Eigen::Vector3d on_arc(0.01 * std::sin(angle), 0.01 * (1 - std::cos(angle)), 0);
    EXPECT_NEAR(tree.nearest(on_arc, 1).distance_m, 1 * mm, 0.35 * mm) << angle;
  }
  const double straight = volume_m3(body_of({.p_from = {0, 0, 0}, .p_to = {0.01, 0, 0}, .radius_m = 1 * mm}, 1 * mm));
  EXPECT_NEAR(straight, 3.14159265358979 * 1e-6 * 0.012, 0.02 * 3.14159265358979 * 1e-6 * 0.012);
}

TEST_F(OwnAnatomy, PinholesAndFlippedPatches) {
  Mesh mesh = test::with_pinholes(*whole_, 97);
  const int missing = static_cast<int>(whole_->triangles.size() - mesh.triangles.size());
  mesh = test::with_flipped_patch(mesh, {0.03, -0.004, 0.018}, 4 * mm);
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_one_sound_lumen(repaired);
  ASSERT_TRUE(note(repaired, "pinhole closed"));
  EXPECT_NEAR(note(repaired, "pinhole closed")->count, missing, 0.05 * missing);
  ASSERT_TRUE(note(repaired, "faced another way"));
  EXPECT_GT(note(repaired, "faced another way")->count, 20);
  EXPECT_LT(worst_radius_mm(repaired.lumen), 0.15);
}

TEST_F(OwnAnatomy, DoubledWallLosesTheOuterOne) {
  const RepairedMesh repaired = repair_mesh(test::with_outer_wall(*whole_, 0.7 * mm));
  expect_one_sound_lumen(repaired);
  ASSERT_TRUE(note(repaired, "outer wall dropped (0.")) << words(repaired);
  EXPECT_LT(worst_radius_mm(repaired.lumen), 0.15);
}

TEST_F(OwnAnatomy, NoiseIsSmoothed) {
  const RepairedMesh repaired = repair_mesh(test::with_noise(*whole_, 0.2 * mm, 7));
  expect_one_sound_lumen(repaired);
  EXPECT_TRUE(note(repaired, "rough surface smoothed"));
  EXPECT_LT(worst_radius_mm(repaired.lumen), 0.15);
}

TEST_F(OwnAnatomy, InsideOutIsTurned) {
  Mesh mesh = *whole_;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_one_sound_lumen(repaired);
  ASSERT_TRUE(note(repaired, "faced inwards"));
  EXPECT_LT(worst_radius_mm(repaired.lumen), 0.1);
}

TEST_F(OwnAnatomy, StenosisOfThreeQuartersSurvives) {
  std::vector<Tube> tubes = *tubes_;
  Tube& lad = tubes[1];
  const double middle = lad.length_m() - 25 * mm, healthy = lad.at(middle).radius_m;
  for (TubeNode& node : lad.nodes)
    if (const double x = std::fabs(node.s_m - middle); x < 6 * mm)
      node.radius_m *= x < 3 * mm ? 0.25 : 0.25 + 0.75 * (x - 3 * mm) / (3 * mm);
  const RepairedMesh repaired = repair_mesh(contour(TubeUnion(tubes)).mesh);
  expect_one_sound_lumen(repaired);
  const double radius = BoundingVolumeHierarchy(repaired.lumen).nearest(lad.at(middle).p, 1).distance_m;
  EXPECT_NEAR(100 * (1 - radius / healthy), 75, 5);
}

TEST(Decimate, SliversSideBySideGo) {
  // Triangles of almost no size, 10 nm and 1 um across, each with six slivers around it, as in level sets.
  for (double share : {1e-5, 1e-3}) {
    Mesh mesh = test::sphere(0.01, 24);
    const std::size_t whole = mesh.triangles.size();
    for (std::size_t t = 0; t < whole; t += 5) {
      const std::array<int, 3> outer = mesh.triangles[t];
      const Eigen::Vector3d middle = test::middle_of(mesh, outer);
      const int first = static_cast<int>(mesh.vertices.size());
      for (int v : outer) mesh.vertices.push_back(middle + share * (mesh.vertices[v] - middle));
      mesh.triangles[t] = {first, first + 1, first + 2};
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        mesh.triangles.push_back({outer[k], outer[next], first + next});
        mesh.triangles.push_back({outer[k], first + next, first + k});
      }
    }
    ASSERT_TRUE(check_surface(mesh).closed());
    const double volume = volume_m3(mesh);
    mesh = decimate(mesh, std::vector<double>(mesh.vertices.size(), 1.5e-3), 20e-6);
    EXPECT_TRUE(check_surface(mesh).sound());
    EXPECT_NEAR(volume_m3(mesh) / volume, 1, 0.02);
    double shortest = 1;
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        shortest = std::min(shortest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
    EXPECT_GT(shortest, 20e-6);
  }
}

TEST(Repair, WhatHoldsNothingIsRefused) {
  EXPECT_THROW(repair_mesh({{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}}), MeshError);
}

TEST(Repair, WhyNothingComesOutIsSaid) {
  const auto said = [](const Mesh& mesh, double voxel_m) -> std::string {
    RepairOptions options;
    options.voxel_m = voxel_m;
    try {
      repair_mesh(mesh, options);
    } catch (const MeshError& error) {
      return error.what();
    }
    return "";
  };
  const Mesh tube = mesh_of(test::BentTube{0.06, 0.003, 0.1});
  EXPECT_EQ(said(tube, 0.1e-3), "");
  EXPECT_NE(said(tube, 1e-6).find("expected 0.013 mm or more"), std::string::npos) << said(tube, 1e-6);
  EXPECT_NE(said(mesh_of(test::BentTube{0.03, 0.0003, 0.1}), 0).find("smaller than 8 mm3"), std::string::npos);
  EXPECT_NE(said(tube, 5e-3).find("voxels of 5 mm are too large"), std::string::npos) << said(tube, 5e-3);
}

}  // namespace
}  // namespace ostium::vascular
