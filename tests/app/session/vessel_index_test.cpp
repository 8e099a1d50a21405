/// The branch a tip is in, and what lies beyond it as seen from the access.
#include "app/session/vessel/vessel_index.h"

#include <gtest/gtest.h>

#include "app/session/recorder/settled_branch.h"

namespace ostium::app {
namespace {

TEST(SettledBranch, CountsBranchesThatATipStaysIn) {
  SettledBranch tip;
  std::vector<int> came;
  std::uint64_t step = 0;
  const auto is_in = [&](int branch, int looks) {
    for (int i = 0; i < looks; ++i, step += 10)
      if (tip.comes_to(branch, step, 1e-3)) came.push_back(branch);
  };
  is_in(2, 100);
  for (int i = 0; i < 50; ++i) is_in(5, 3), is_in(2, 3);
  EXPECT_EQ(came, (std::vector<int>{2})) << "to and fro at the border is no coming";
  is_in(5, 30);
  EXPECT_EQ(came, (std::vector<int>{2})) << "29 looks after the first are 0.29 s";
  is_in(5, 1), is_in(5, 100), is_in(-1, 1), is_in(5, 31);
  EXPECT_EQ(came, (std::vector<int>{2, 5, 5})) << "out of the body it is at once";
  came.clear();
  for (int i = 0; i < 20; ++i) is_in(7, 45), is_in(5, 45);
  EXPECT_EQ(came, (std::vector<int>{7})) << "twice a beat, with the heart";
  is_in(5, 151), is_in(8, 31);
  EXPECT_EQ(came, (std::vector<int>{7, 5, 8}));
}

/// A trunk from the access, with a branch whose origin is 5 mm from the trunk's axis.
TEST(VesselIndex, KnowsWhatIsBeyondWhat) {
  vascular::SphereTree tree;
  vascular::TreeBranch trunk{.name = "trunk", .spheres = {}},
      branch{.name = "branch", .parent = 0, .parent_sphere = 50, .spheres = {}};
  for (int i = 0; i <= 100; ++i) trunk.spheres.push_back({{1e-3 * i, 0, 0}, 5e-3, 1e-3 * i});
  for (int i = 0; i <= 40; ++i) branch.spheres.push_back({{0.05, 1e-3 * i, 0}, 2e-3, 1e-3 * i});
  tree.branches = {trunk, branch};
  const VesselIndex way({tree}, Eigen::Vector3d(0.1, 0, 0),
                        {{"middle", Eigen::Vector3d(0.05, 0, 0.001)}});  // from the far end
  const int middle = way.place("middle"), twig = way.place("branch"), far = way.place("branch+20");
  EXPECT_NEAR(way.from_access_m(middle), 0.05, 1e-9);
  EXPECT_NEAR(way.from_access_m(twig), 0.055, 1e-9) << "where it leaves the trunk's wall";
  EXPECT_NEAR(way.from_access_m(far), 0.075, 1e-9);
  const auto at = [&](double x, double y) { return way.locate({x, y, 0}, 0); };
  EXPECT_FALSE(way.beyond(at(0.08, 0), middle));
  EXPECT_TRUE(way.beyond(at(0.02, 0), middle));
  EXPECT_FALSE(way.beyond(at(0.02, 0), twig));
  EXPECT_TRUE(way.beyond(at(0.05, 0.03), twig));
  EXPECT_TRUE(way.beyond(at(0.05, 0.03), far));
  EXPECT_FALSE(way.beyond(at(0.05, 0.01), far));
  EXPECT_TRUE(way.beyond(at(0.05, 0.03), middle));
  EXPECT_EQ(way.branch(at(0.05, 0.003)), 0) << "within the trunk";
  const int leaving = way.branch(far);
  EXPECT_EQ(way.astray_m(at(0.02, 0), 0), 0);
  EXPECT_EQ(way.astray_m(far, leaving), 0);
  EXPECT_EQ(way.astray_m(at(0.02, 0), leaving), -1) << "the trunk does not leave the branch";
  EXPECT_NEAR(way.astray_m(far, 0), way.from_access_m(far) - way.from_access_m(at(0.05, 0)), 1e-9);
  const VesselIndex::Departure leaves = way.departure(far, 0);
  EXPECT_NEAR(std::fabs(leaves.along.x()), 1, 1e-9);
  EXPECT_NEAR(leaves.side.y(), 1, 1e-9);
  EXPECT_TRUE(way.departure(middle, 0).side.isZero()) << "a trunk leaves nothing";
  EXPECT_EQ(way.place("trunk"), at(0.1, 0)) << "for whom comes from the access";
  for (const char* none : {"twig", "branch+", "branch+500", "branch+x", "branch-", "branch-60", "trunk-3"})
    EXPECT_EQ(way.place(none), -1) << none;
  EXPECT_NEAR(way.p(way.place("branch-3"), 0).x(), 0.053, 1.1e-3) << "before it, for whom comes from the access";
}

/// A plaque on one side of the trunk leaves a narrow lumen off the middle; the branch leaves where it does all the
/// same.
TEST(VesselIndex, APlaqueMovesNoMouth) {
  vascular::TreeBranch trunk{.name = "trunk", .spheres = {}},
      branch{.name = "branch", .parent = 0, .parent_sphere = 50, .spheres = {}};
  for (int i = 0; i <= 100; ++i) {
    const double plaque = std::abs(i - 50) < 8 ? 1 : 0;
    trunk.spheres.push_back({{1e-3 * i, 0, 3e-3 * plaque}, 5e-3 - 3e-3 * plaque, 1e-3 * i});
  }
  for (int i = 0; i <= 40; ++i) branch.spheres.push_back({{0.05, 1e-3 * i, 0}, 2e-3, 1e-3 * i});
  const VesselIndex way({{.branches = {trunk, branch}}}, Eigen::Vector3d(0, 0, 0), {});
  EXPECT_NEAR(way.p(way.entry("branch"), 0).y(), 4e-3, 1e-9) << "as the sphere 5 mm from the lumen's middle";
  EXPECT_EQ(way.branch(way.locate({0.05, 0.5e-3, 1.5e-3}, 0)), 0) << "in the trunk's lumen";
  EXPECT_NEAR(way.departure(way.entry("branch"), 0).side.y(), 1, 1e-9);
}

}  // namespace
}  // namespace ostium::app
