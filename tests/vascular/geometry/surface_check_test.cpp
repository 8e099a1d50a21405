/// Each deliberate fault is found at its position.
#include "vascular/geometry/mesh/surface_check.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/vascular/geometry/bent_tube.h"
#include "tests/vascular/geometry/shapes.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {
namespace {

TEST(SurfaceCheck, ASphereIsSound) {
  const SurfaceReport r = check_surface(test::sphere(0.01, 32));
  EXPECT_TRUE(r.sound()) << describe(r);
  EXPECT_EQ(r.components, 1);
  EXPECT_NEAR(r.volume_m3, 4.0 / 3 * units::pi * 1e-6, 0.01 * 4.2e-6);  // inscribed: (pi/n)^2 / 2 smaller
  EXPECT_EQ(describe(r), "sound\n");
}

TEST(SurfaceCheck, AHoleHasThreeOpenEdgesAroundIt) {
  Mesh m = test::sphere(0.01, 16);
  const Eigen::Vector3d where = m.vertices[m.triangles[40][0]];
  m.triangles.erase(m.triangles.begin() + 40);
  const SurfaceReport r = check_surface(m);
  EXPECT_EQ(r.open_edges.count, 3);
  EXPECT_FALSE(r.closed());
  EXPECT_LT((r.open_edges.where[0] - where).norm(), 0.005);
  EXPECT_NE(describe(r).find("3 open edges, the first at"), std::string::npos);
}

TEST(SurfaceCheck, WhatIsOpenHasTheVolumeUnderLids) {
  test::BentTube tube{0.09, 0.006, 0.03};  // both ends look the same way
  const SurfaceReport closed = check_surface(mesh_of(tube));
  tube.lids = false;
  Mesh open = mesh_of(tube);
  EXPECT_NEAR(check_surface(open).volume_m3, closed.volume_m3, 1e-6 * closed.volume_m3);
  // Far from the middle of the whole, a piece faces outwards all the same.
  Mesh other = open;
  for (auto& p : other.vertices) p += Eigen::Vector3d(0, 0.5, 0);
  append(open, other);
  const SurfaceReport both = check_surface(open);
  EXPECT_EQ(both.components, 2);
  EXPECT_EQ(both.inverted.count, 0);
  EXPECT_NEAR(both.volume_m3, 2 * closed.volume_m3, 2e-6 * closed.volume_m3);
}

TEST(SurfaceCheck, OneTriangleTheWrongWayRound) {
  Mesh m = test::sphere(0.01, 16);
  std::swap(m.triangles[40][0], m.triangles[40][1]);
  EXPECT_EQ(check_surface(m).flipped_edges.count, 3);
}

TEST(SurfaceCheck, InsideOut) {
  Mesh m = test::cube(0.01);
  for (auto& t : m.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(check_surface(m).inverted.count, 1);
  EXPECT_TRUE(check_surface(m).closed());
  EXPECT_TRUE(check_surface(m, true).sound());
}

TEST(SurfaceCheck, AnInnerWallMakesEdgesOfThreeTriangles) {
  Mesh m = test::cube(0.01);
  m.triangles.push_back({0, 1, 7});
  m.triangles.push_back({0, 7, 6});
  EXPECT_GT(check_surface(m).branching_edges.count, 0);
}

TEST(SurfaceCheck, TwoSheetsInOneVertex) {
  Mesh m = test::cube(0.01), other = test::cube(0.01);
  for (auto& p : other.vertices) p += Eigen::Vector3d::Constant(0.01);  // its corner 0 on the first one's corner 7
  append(m, other);
  for (auto& t : m.triangles)
    for (int& v : t)
      if (v == 8) v = 7;
  const SurfaceReport r = check_surface(m);
  EXPECT_EQ(r.pinched_vertices.count, 1);
  EXPECT_LT((r.pinched_vertices.where[0] - Eigen::Vector3d::Constant(0.01)).norm(), 1e-12);
  EXPECT_EQ(r.crossings.count, 0);  // touching is not crossing
}

TEST(SurfaceCheck, TwoSpheresThatOverlapCrossOnTheirCommonCircle) {
  Mesh m = test::sphere(0.01, 24);
  append(m, test::sphere(0.01, 25, {0.012, 0.0003, 0.0002}));
  const SurfaceReport r = check_surface(m);
  EXPECT_EQ(r.components, 2);
  EXPECT_GT(r.crossings.count, 30);
  for (const Eigen::Vector3d& p : r.crossings.where) EXPECT_NEAR(p.x(), 0.006, 0.0015);
  Mesh apart = test::sphere(0.01, 24);
  append(apart, test::sphere(0.01, 24, {0.0201, 0, 0}));
  EXPECT_TRUE(check_surface(apart).sound());
}

TEST(SurfaceCheck, ASpikeThatGoesThroughItsOwnSurface) {
  Mesh m = test::sphere(0.01, 16);
  m.vertices[0] = {0.001, 0.0013, -0.02};  // the pole, pushed through the opposite side
  EXPECT_GT(check_surface(m).crossings.count, 0);
}

TEST(BoundingVolumeHierarchy, NearestPointOfASphere) {
  const Mesh m = test::sphere(0.01, 64);
  const BoundingVolumeHierarchy tree(m);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.02, 0.01, 0.005), Eigen::Vector3d(0.001, -0.002, 0.003)}) {
    // The chords of 64 rows lie within r (pi/64)^2 / 8 of the arc, those of the columns as much again.
    EXPECT_NEAR(tree.nearest(p, 1).distance_m, std::fabs(p.norm() - 0.01), 0.01 * 2 * 0.0024 / 8 + 1e-9);
    EXPECT_EQ(tree.nearest(p, 0.001).triangle, -1);
  }
}

}  // namespace
}  // namespace ostium::vascular
