/// What is one sheet of a surface, which way it faces, and how often it goes round a point.
#include "vascular/geometry/repair/sheets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/units.h"
#include "tests/vascular/geometry/shapes.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh/winding.h"
#include "vascular/geometry/repair/double_wall.h"

namespace ostium::vascular {
namespace {

using units::mm;

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

TEST(Sheets, TwoTubesThatShareALineStayTwo) {
  Mesh mesh = test::tube(5 * mm, 0.2, 36, 80, true);
  const Mesh other = mesh;
  const auto n = static_cast<int>(mesh.vertices.size());
  std::vector<int> number;  // of the other's vertices, where those on the line are the first one's
  for (const Eigen::Vector3d& p : other.vertices) {
    const Eigen::Vector3d moved = p + Eigen::Vector3d(10 * mm, 0, 0);
    const auto same = std::find_if(mesh.vertices.begin(), mesh.vertices.begin() + n,
                                   [&](const Eigen::Vector3d& q) { return (q - moved).norm() < 1e-9; });
    number.push_back(same == mesh.vertices.begin() + n ? static_cast<int>(mesh.vertices.size())
                                                       : static_cast<int>(same - mesh.vertices.begin()));
    if (number.back() >= n) mesh.vertices.push_back(moved);
  }
  ASSERT_LT(mesh.vertices.size(), 2 * other.vertices.size() - 50);
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({number[a], number[b], number[c]});
  Sheets sheets = sheets_of(mesh);
  const Orientation orientation = orient(mesh, sheets);
  EXPECT_EQ(sheets.pieces, 2);
  EXPECT_TRUE(orientation.flipped.empty() && orientation.inverted.empty());
  EXPECT_EQ(find_double_wall(mesh, sheets).triangles, 0);
}

}  // namespace
}  // namespace ostium::vascular
