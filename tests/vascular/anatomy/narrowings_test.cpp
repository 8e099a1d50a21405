/// Narrowings that a lumen already has, on branches of known radii.
#include "vascular/anatomy/labelling/narrowings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/units.h"

namespace ostium::vascular {
namespace {

/// A straight branch of 100 mm along x.
SphereTree branch_with(const std::function<double(double)>& radius_mm) {
  TreeBranch branch;
  branch.name = "LAD";
  for (double s = 0; s <= 100; s += 0.5) {
    TreeSphere sphere;
    sphere.s_m = 1e-3 * s, sphere.p = {1e-3 * s, 0, 0}, sphere.radius_m = 1e-3 * radius_mm(s);
    branch.spheres.push_back(sphere);
  }
  SphereTree tree;
  tree.branches.push_back(branch);
  return tree;
}

double notch(double s, double at_mm, double half_mm) {
  const double x = (s - at_mm) / half_mm;
  return std::fabs(x) < 1 ? 0.5 * (1 + std::cos(units::pi * x)) : 0;
}

TEST(Narrowings, OneWithThreeTightPlacesIsOne) {
  // 20 mm of 3 mm, tight at 43, 50 and 57 mm, and wide again in between.
  const auto found = find_narrowings(branch_with(
      [](double s) { return 1.5 * (1 - 0.6 * notch(s, 43, 3) - 0.7 * notch(s, 50, 3) - 0.55 * notch(s, 57, 3)); }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].at_m, 50e-3, 0.6e-3);
  EXPECT_NEAR(found[0].stenosis, 0.7, 0.05);
  EXPECT_NEAR(found[0].reference_m, 3e-3, 0.3e-3);
  // 1 - 0.6 notch is 0.7 half way, 1.5 mm from its middle; 1 - 0.55 notch is that 1.4 mm from its middle.
  EXPECT_NEAR(found[0].from_m, 41.5e-3, 0.6e-3);
  EXPECT_NEAR(found[0].to_m, 58.4e-3, 0.6e-3);
}

TEST(Narrowings, AMildOneIsAsLongAsASevereOneOfItsShape) {
  for (const double depth : {0.35, 0.7, 0.9}) {
    const auto found = find_narrowings(branch_with([&](double s) { return 1.5 * (1 - depth * notch(s, 50, 6)); }));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].to_m - found[0].from_m, 6.5e-3, 1.1e-3) << depth;
  }
}

TEST(Narrowings, ThreeDiametersApartTheyAreTwo) {
  const auto found =
      find_narrowings(branch_with([](double s) { return 1.5 * (1 - 0.6 * notch(s, 35, 4) - 0.5 * notch(s, 60, 4)); }));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].at_m, 35e-3, 0.6e-3);
  EXPECT_NEAR(found[1].at_m, 60e-3, 0.6e-3);
  EXPECT_NEAR(found[0].to_m - found[0].from_m, 4e-3, 1.1e-3);
  // 1 - 0.5 notch is 0.7 where cos is 0.2, 1.74 mm from its middle.
  EXPECT_NEAR(found[1].to_m - found[1].from_m, 3.5e-3, 1.1e-3);
}

/// Longer than what it is compared with beside it: by the whole branch.
TEST(Narrowings, ALongOneIsAsDeepAsAShortOne) {
  for (const double flat_mm : {0.0, 12.0, 25.0, 35.0}) {
    const auto found = find_narrowings(branch_with([&](double s) {
      return (2 - 0.004 * s) *
             (1 - 0.7 * (std::fabs(s - 50) < flat_mm / 2 ? 1 : notch(std::fabs(s - 50), flat_mm / 2, 4)));
    }));
    ASSERT_EQ(found.size(), 1u) << flat_mm;
    EXPECT_NEAR(found[0].stenosis, 0.7, 0.05) << flat_mm;
    EXPECT_NEAR(found[0].to_m - found[0].from_m, 1e-3 * flat_mm + 4.3e-3, 1.5e-3) << flat_mm;
  }
  const auto cosine = find_narrowings(branch_with([](double s) { return 2 * (1 - 0.7 * notch(s, 50, 30)); }));
  ASSERT_EQ(cosine.size(), 1u);
  EXPECT_NEAR(cosine[0].stenosis, 0.7, 0.05);
}

/// Of a narrow stretch spheres lie denser: by number most of the branch would be narrow.
TEST(Narrowings, ALongOneCountsByItsLengthNotByItsSpheres) {
  for (const double flat_mm : {20.0, 32.0, 40.0}) {
    TreeBranch branch;
    branch.name = "LAD";
    for (double s = 0; s <= 100;) {
      const double radius_mm = std::fabs(s - 50) < flat_mm / 2 ? 1.0 : 2.0 - notch(std::fabs(s - 50), flat_mm / 2, 2);
      branch.spheres.push_back({{1e-3 * s, 0, 0}, 1e-3 * radius_mm, 1e-3 * s});
      s += radius_mm / 2;
    }
    SphereTree tree;
    tree.branches.push_back(branch);
    const auto found = find_narrowings(tree);
    ASSERT_EQ(found.size(), 1u) << flat_mm;
    EXPECT_NEAR(found[0].stenosis, 0.5, 0.05) << flat_mm;
    EXPECT_NEAR(found[0].reference_m, 4e-3, 0.3e-3) << flat_mm;
  }
}

/// Each lies where the other is compared with.
TEST(Narrowings, OneBehindAnotherTheyAreAsDeepAsAlone) {
  const auto found = find_narrowings(branch_with(
      [](double s) { return 2 * (1 - 0.6 * notch(s, 38, 5) - 0.6 * notch(s, 62, 5) - 0.6 * notch(s, 80, 5)); }));
  ASSERT_EQ(found.size(), 3u);
  for (const FoundNarrowing& one : found) EXPECT_NEAR(one.stenosis, 0.6, 0.04) << one.at_m;
}

/// A vessel that is smaller behind a large branch, and stays so, is none.
TEST(Narrowings, AVesselThatStaysSmallIsNone) {
  EXPECT_TRUE(find_narrowings(branch_with([](double s) {
                return s < 55 ? 1.8 : s < 60 ? 1.8 - 0.14 * (s - 55) : 1.1;
              })).empty());
}

TEST(Narrowings, AHealthyVesselHasNone) {
  EXPECT_TRUE(find_narrowings(branch_with([](double s) { return 2 - 0.01 * s + 0.1 * std::sin(s); })).empty());
}

TEST(Narrowings, BesideAnAneurysmTheHealthyVesselIsNone) {
  const auto bulging = [](double s) { return (2 - 0.012 * s) * (1 + 1.5 * notch(s, 60, 10)); };
  EXPECT_TRUE(find_narrowings(branch_with(bulging)).empty());
  // One that is there is told by the vessel, and not by the bulge.
  const auto found = find_narrowings(branch_with([&](double s) { return bulging(s) * (1 - 0.6 * notch(s, 42, 4)); }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].at_m, 42e-3, 0.6e-3);
  EXPECT_NEAR(found[0].stenosis, 0.6, 0.08);
}

}  // namespace
}  // namespace ostium::vascular
