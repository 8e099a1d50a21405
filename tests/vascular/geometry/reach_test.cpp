/// What of a lumen a centreline does not lead to.
#include "vascular/geometry/centreline/reach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {
namespace {

using units::pi;

constexpr double radius_m = 2e-3, length_m = 80e-3;

Mesh rings() {
  Mesh mesh;
  for (int i = 0; i <= 160; ++i)
    for (int k = 0; k < 12; ++k)
      mesh.vertices.emplace_back(radius_m * std::cos(k * pi / 6), radius_m * std::sin(k * pi / 6), i * length_m / 160);
  return mesh;
}

SphereTree line_to(double end_m) {
  SphereTree tree;
  TreeBranch& branch = tree.branches.emplace_back();
  branch.name = "RCA";
  for (double s = 0; s <= end_m; s += 0.5e-3) branch.spheres.push_back({{0, 0, s}, radius_m, s});
  return tree;
}

TEST(Reach, ALineThatEndsHalfwayLeavesTheRest) {
  EXPECT_EQ(unreached(rings(), line_to(length_m)).share, 0);
  const Unreached half = unreached(rings(), line_to(length_m / 2));
  // Three radii and 1.5 mm beyond the last sphere are its own, along the wall.
  const double own_m = std::sqrt(std::pow(3 * radius_m + 1.5e-3, 2) - radius_m * radius_m);
  EXPECT_NEAR(half.share, 0.5 - own_m / length_m, 0.01);
  EXPECT_NEAR(half.p.z(), length_m / 2 + own_m, 1e-3);
  EXPECT_GT(half.share, unreached_matters);
  EXPECT_EQ(half.branch, "RCA") << "is cut short there";
  EXPECT_EQ(unreached(rings(), {}).share, 1);
}

}  // namespace
}  // namespace ostium::vascular
