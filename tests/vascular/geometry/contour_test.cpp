/// Contours of shapes whose volume and area are known.
#include "vascular/geometry/implicit/contour.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "vascular/geometry/mesh/surface_check.h"

namespace ostium::vascular {
namespace {

using units::pi;

TEST(Contour, ACapsuleHasItsVolumeAndArea) {
  const double r = 2e-3, l = 20e-3;
  const std::vector<Tube> tubes = {make_tube("a", -1, {{{0, 0, 0}, r}, {{0.6 * l, 0.8 * l, 0}, r}})};
  const Contour c = contour(TubeUnion(tubes));
  const SurfaceReport report = check_surface(c.mesh);
  EXPECT_TRUE(report.sound()) << describe(report);
  // Vertices lie on the surface; cells of 0.68 mm give 18 around, whose chords cut off (2 pi / 18)^2 / 6 of the
  // section.
  EXPECT_NEAR(report.volume_m3 / (pi * r * r * (l + 4.0 / 3 * r)), 1, 0.025);
  EXPECT_NEAR(report.area_m2 / (2 * pi * r * (l + 2 * r)), 1, 0.02);
  for (const Eigen::Vector3d& p : c.mesh.vertices) {
    const double t = std::clamp(p.dot(Eigen::Vector3d(0.6, 0.8, 0)), 0.0, l);
    EXPECT_NEAR((p - t * Eigen::Vector3d(0.6, 0.8, 0)).norm(), r, 2e-6);
  }
}

TEST(Contour, ATaperFromTenToOneMillimetreIsFineWhereItIsThin) {
  const std::vector<Tube> tubes = {make_tube("a", -1, {{{0, 0, 0}, 10e-3}, {{0.1, 0, 0}, 1e-3}})};
  const Mesh mesh = contour(TubeUnion(tubes)).mesh;
  EXPECT_TRUE(check_surface(mesh).sound());
  const auto edge = [&](double from, double to) {
    double sum = 0;
    int count = 0;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]];
      if (a.x() > from && a.x() < to) sum += (a - b).norm(), ++count;
    }
    return sum / count;
  };
  EXPECT_GT(edge(0, 0.01), 2 * edge(0.09, 0.1));
}

TEST(Contour, AFork) {
  // One piece, no inner wall, no handle; shares of each vertex add up to one.
  const std::vector<Tube> tubes = {make_tube("trunk", -1, {{{0, 0, 0}, 2e-3}, {{0.03, 0, 0}, 2e-3}}),
                                   make_tube("branch", 0, {{{0.012, 0, 0}, 1.2e-3}, {{0.025, 0.012, 0}, 1e-3}})};
  const Contour c = contour(TubeUnion(tubes));
  const SurfaceReport report = check_surface(c.mesh);
  EXPECT_TRUE(report.sound()) << describe(report);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.vertices - report.triangles / 2, 2);
  for (const auto& shares : c.shares) {
    double sum = 0;
    for (const TubeShare& share : shares) sum += share.weight;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Contour, TheGradientIsThatOfTheFunction) {
  const std::vector<Tube> tubes = {make_tube("trunk", -1, {{{0, 0, 0}, 2e-3}, {{0.03, 0, 0}, 2e-3}}),
                                   make_tube("branch", 0, {{{0.012, 0, 0}, 1.2e-3}, {{0.025, 0.012, 0}, 1.2e-3}})};
  const TubeUnion both(tubes);
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(both.segments().size()); ++i) all.push_back(i);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.016, 0.0026, 0.0004), Eigen::Vector3d(0.005, 0.001, 0.002)}) {
    Eigen::Vector3d gradient, numeric;
    both.value(p, all, &gradient);
    constexpr double h = 1e-7;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
      numeric[axis] = (both.value(p + step, all) - both.value(p - step, all)) / (2 * h);
    }
    EXPECT_LT((gradient - numeric).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace ostium::vascular
