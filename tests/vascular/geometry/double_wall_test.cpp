/// What is the outer shell of a wall goes, and what only looks like one stays.
#include "vascular/geometry/repair/double_wall.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tests/vascular/geometry/damage.h"
#include "tests/vascular/geometry/shapes.h"
#include "vascular/geometry/mesh/surface_check.h"
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

}  // namespace
}  // namespace ostium::vascular
