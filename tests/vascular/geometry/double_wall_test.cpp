/// What is the outer shell of a wall goes, and what only looks like one stays; limbs that nearly touch stay apart.
#include "vascular/geometry/repair/double_wall.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tests/vascular/geometry/damage.h"
#include "tests/vascular/geometry/shapes.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/repair/limbs.h"
#include "vascular/geometry/repair/repair.h"
#include "vascular/geometry/repair/units.h"

namespace ostium::vascular {
namespace {

using units::mm;

TEST(DoubleWalls, OfAWallThatIsASolidTheLumenIsWhatItHolds) {
  constexpr double length = 0.2;
  for (const auto& [radius, thickness] : {std::pair{10 * mm, 2 * mm}, {10 * mm, 6 * mm}, {3 * mm, 6 * mm}}) {
    const Mesh mesh = test::wall(radius, thickness, length, 36, 80);
    ASSERT_TRUE(check_surface(mesh).sound());
    const RepairedMesh repaired = repair_mesh(mesh);
    EXPECT_EQ(repaired.lumens, 1);
    EXPECT_EQ(repaired.ends.size(), 2u);
    // The corners of the result lie on the wall, its edges are chords of it: up to 0.6 mm (r / 1 mm)^0.75 and 2.2 mm.
    const double chord = std::min(0.6 * mm * std::pow(radius / mm, 0.75), 2.2 * mm),
                 cut = std::pow(chord / radius, 2) / 6;
    const double expected = length * test::polygon_area(radius, 36);
    EXPECT_NEAR(volume_m3(repaired.lumen), (1 - cut / 2) * expected, (0.005 + cut / 2) * expected)
        << radius << thickness;
  }
}

/// Two closed shells, of which the outer one has thicker ends than walls: its lids go with it.
TEST(DoubleWalls, AnOuterShellGoesWithItsLids) {
  for (const auto& [wall, end] : {std::pair{0.5 * mm, 2 * mm}, {1 * mm, 4 * mm}, {1 * mm, 1 * mm}, {1 * mm, 9 * mm}}) {
    Mesh mesh = test::tube(2 * mm, 96 * mm, 40, 120);
    Mesh outer = test::tube(2 * mm + wall, 96 * mm + 2 * end, 40, 120);
    for (Eigen::Vector3d& p : outer.vertices) p.z() -= end;
    append(mesh, outer);
    const RepairedMesh repaired = repair_mesh(mesh);
    EXPECT_EQ(repaired.lumens, 1) << wall << " " << end;
    EXPECT_NEAR(volume_m3(repaired.lumen), 96 * mm * test::polygon_area(2 * mm, 40), 0.03 * 1.2e-6)
        << wall << " " << end;
  }
}

TEST(DoubleWalls, TwoTubesSideBySideAreNoWall) {
  for (const double apart : {20 * mm, 10.05 * mm, 9.95 * mm}) {  // almost touch; cross
    Mesh mesh = test::tube(5 * mm, 0.2, 36, 80, true), other = mesh;
    for (Eigen::Vector3d& p : other.vertices) p.x() += apart;
    append(mesh, other);
    Sheets sheets = sheets_of(mesh);
    orient(mesh, sheets);
    EXPECT_EQ(find_double_wall(mesh, sheets).triangles, 0) << apart;
  }
}

/// Tubes with lids whose beginnings lie in one another, as people build a fork.
TEST(DoubleWalls, BranchesThatBeginInTheirParentAreNoWall) {
  Mesh mesh = test::tube(3.3 * mm, 40 * mm, 48, 60);
  for (const auto& [radius, degrees] : {std::pair{2.6 * mm, 26.0}, {2.2 * mm, -26.0}}) {
    Mesh branch = test::tube(radius, 45 * mm, 48, 60);
    const Eigen::AngleAxisd turn(degrees * units::degree, Eigen::Vector3d::UnitY());
    for (Eigen::Vector3d& p : branch.vertices) p = turn * p + Eigen::Vector3d(0, 0, 37 * mm);
    append(mesh, branch);
  }
  Sheets sheets = sheets_of(mesh);
  orient(mesh, sheets);
  EXPECT_EQ(find_double_wall(mesh, sheets).triangles, 0);
  EXPECT_EQ(repair_mesh(mesh).lumens, 1);
}

TEST(DoubleWalls, AWallsUnitIsThatOfItsLumen) {
  const Mesh in_mm = test::scaled(test::wall(10 * mm, 2 * mm, 0.25, 36, 80), 1e3);
  EXPECT_TRUE(unit_readings(vessel_size(in_mm)).empty()) << "twice the wall's thickness is no artery's width";
  for (const double thickness : {2 * mm, 6 * mm})
    for (const bool turned : {false, true}) {
      Mesh wall = test::scaled(test::wall(10 * mm, thickness, 0.25, 36, 80), 1e3);
      if (turned)
        for (auto& t : wall.triangles) std::swap(t[1], t[2]);
      EXPECT_NEAR(vessel_size(without_outer_wall(wall)).wide, 20, 0.2) << thickness << turned;
    }
  const VesselSize size = vessel_size(without_outer_wall(in_mm));
  const std::vector<UnitReading> readings = unit_readings(size);
  EXPECT_TRUE(std::any_of(readings.begin(), readings.end(),
                          [](const UnitReading& r) { return r.unit == LengthUnit::millimetre; }));
}

/// A coil of two turns, 3 mm wide.
Mesh coil(double apart_m) {
  constexpr int rows = 160, columns = 24;
  constexpr double radius = 1.5 * mm, bend = 8 * mm;
  const double rise = (2 * radius + apart_m) / (2 * units::pi);
  Mesh mesh = test::tube(radius, 1, columns, rows);
  for (Eigen::Vector3d& p : mesh.vertices) {
    const double angle = 4 * units::pi * p.z();
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
    p = (bend + p.x()) * out + Eigen::Vector3d(0, 0, rise * angle + p.y());
  }
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(Limbs, TurnsOfACoilStayApart) {
  for (const double apart : {0.2 * mm, 0.3 * mm}) {
    const Mesh mesh = coil(apart);
    ASSERT_TRUE(check_surface(mesh).sound());
    const std::optional<NearLimbs> near = nearest_limbs(mesh, 1 * mm);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->gap_m, apart, 0.05 * mm);
    const Mesh lumen = repair_mesh(mesh).lumen;
    // Corners less edges and triangles: 2 of a tube with lids, less 2 for each loop.
    EXPECT_EQ(static_cast<long>(lumen.vertices.size()) - static_cast<long>(lumen.triangles.size()) / 2, 2) << apart;
    EXPECT_NEAR(volume_m3(lumen), volume_m3(mesh), 0.03 * volume_m3(mesh));
  }
}

TEST(Limbs, WhereTheyMayHaveMergedIsSaid) {
  RepairOptions options;
  options.voxel_m = 0.4 * mm;
  const RepairedMesh repaired = repair_mesh(coil(0.2 * mm), options);
  EXPECT_TRUE(std::any_of(repaired.notes.begin(), repaired.notes.end(), [](const RepairNote& n) {
    return n.what.find("limbs of one vessel") != std::string::npos &&
           n.what.find("keeps them apart") != std::string::npos;
  }));
}

/// Not where its branches part.
TEST(Limbs, AForkHasNone) {
  const std::vector<Tube> fork = {
      make_tube("trunk", -1, {{{0, 0, 0}, 2 * mm}, {{0, 0, 0.02}, 2 * mm}, {{0.006, 0, 0.05}, 2 * mm}}),
      make_tube("branch", 0, {{{0, 0, 0.02}, 2 * mm}, {{-0.006, 0, 0.05}, 2 * mm}})};
  EXPECT_FALSE(nearest_limbs(contour(TubeUnion(fork), {}).mesh, 0.8 * mm));
}

}  // namespace
}  // namespace ostium::vascular
