/// Courses that a person edits, in a lumen whose tubes are known: what is moved comes back to the middle, what is left
/// out is found again, names stay where they are in space, and what cannot be is refused.
#include "vascular/anatomy/editing/edit_anatomy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vascular/anatomy/editing/course_check.h"
#include "vascular/geometry/implicit/contour.h"

namespace ostium::vascular {
namespace {

/// 100 mm along x, 4 mm wide, with a branch of 30 mm and 3 mm that leaves it upwards at 40 mm.
Anatomy fork() {
  Anatomy anatomy;
  anatomy.aorta = false;
  anatomy.tubes = {make_tube("", -1, {{{0, 0, 0}, 2e-3}, {{0.05, 0, 0}, 0}, {{0.1, 0, 0}, 2e-3}}),
                   make_tube("", 0, {{{0.04, 0, 0}, 1.5e-3}, {{0.04, 0.016, 0}, 0}, {{0.04, 0.032, 0}, 1.5e-3}})};
  anatomy.branches = {{"main", 0, 0, 0.1}, {"side", 1, 2e-3, anatomy.tubes[1].length_m()}};
  anatomy.landmarks.p_access = {2e-3, 0, 0}, anatomy.landmarks.access_direction = {1, 0, 0};
  return anatomy;
}

struct Bench {
  Anatomy anatomy = fork();
  Mesh wall = contour(TubeUnion(anatomy.tubes)).mesh;
  LumenGauge gauge{wall};
};

const Bench& bench() {
  static const Bench made;
  return made;
}

std::size_t node_at(const Tube& tube, double s_m) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < tube.nodes.size(); ++i)
    if (std::abs(tube.nodes[i].s_m - s_m) < std::abs(tube.nodes[best].s_m - s_m)) best = i;
  return best;
}

std::string refusal(const auto& edit) {
  try {
    edit();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(EditAnatomy, TheGaugeKnowsWallAndMiddle) {
  const LumenGauge& gauge = bench().gauge;
  EXPECT_NEAR(gauge.clearance_m({0.07, 0, 0}), 2e-3, 0.03e-3);
  EXPECT_NEAR(gauge.clearance_m({0.07, 0.0015, 0}), 0.5e-3, 0.03e-3);
  EXPECT_NEAR(gauge.clearance_m({0.07, 0.003, 0}), -1e-3, 0.03e-3);
  const Eigen::Vector3d middle = gauge.centred({0.07, 0.0012, -0.0009}, {1, 0, 0});
  EXPECT_LT(Eigen::Vector3d(middle - Eigen::Vector3d(0.07, 0, 0)).norm(), 0.06e-3);
  EXPECT_EQ(gauge.centred({0.07, 0.01, 0}, {1, 0, 0}), Eigen::Vector3d(0.07, 0.01, 0)) << "outside it stays";
}

TEST(EditAnatomy, ACourseThatFitsHasNoFault) { EXPECT_TRUE(check_courses(bench().anatomy, bench().gauge).empty()); }

TEST(EditAnatomy, AMovedSphereTakesItsNeighboursAlongAndIsFoundFault) {
  const Bench& b = bench();
  const std::size_t node = node_at(b.anatomy.tubes[0], 0.07);
  const Eigen::Vector3d from = b.anatomy.tubes[0].nodes[node].p;
  const Anatomy moved = with_moved_node(b.anatomy, b.gauge, 0, node, from + Eigen::Vector3d(0, 5e-3, 0), 10e-3);
  const Tube& tube = moved.tubes[0];
  const auto height = [&](double x) {
    return std::ranges::min_element(tube.nodes, {}, [&](const TubeNode& one) { return std::abs(one.p.x() - x); })
        ->p.y();
  };
  EXPECT_NEAR(height(0.07), 5e-3, 0.1e-3);
  EXPECT_NEAR(height(0.075), 2.5e-3, 0.4e-3) << "half a cosine: half of it half-way";
  EXPECT_NEAR(height(0.081), 0, 1e-6);
  EXPECT_GT(tube.length_m(), b.anatomy.tubes[0].length_m());
  for (std::size_t i = 1; i < tube.nodes.size(); ++i)
    EXPECT_LT(tube.nodes[i].s_m - tube.nodes[i - 1].s_m, tube.nodes[i].radius_m) << "neighbours overlap";

  const auto faults = check_courses(moved, b.gauge);
  const auto outside = std::ranges::find(faults, CourseFault::Kind::outside, &CourseFault::kind);
  ASSERT_NE(outside, faults.end());
  EXPECT_NEAR(outside->worst_m, 3e-3, 0.1e-3);
  EXPECT_NEAR(tube.at(outside->worst_at_m).p.x(), 0.07, 0.5e-3);

  // Within the lumen, its radius is what is left, and the middle is found again.
  const Anatomy aside = with_moved_node(b.anatomy, b.gauge, 0, node, from + Eigen::Vector3d(0, 1e-3, 0), 10e-3);
  EXPECT_NEAR(aside.tubes[0].nodes[node_at(aside.tubes[0], 0.0702)].radius_m, 1e-3, 0.06e-3);
  const Anatomy back = with_centred_course(aside, b.gauge, 0, 0.055, 0.085);
  for (const TubeNode& one : back.tubes[0].nodes)
    if (one.p.x() > 0.056 && one.p.x() < 0.084) {
      EXPECT_LT(std::hypot(one.p.y(), one.p.z()), 0.08e-3);
      EXPECT_NEAR(one.radius_m, 2e-3, 0.05e-3);
    }
}

TEST(EditAnatomy, NamesStayWhereTheyAreInSpace) {
  const Bench& b = bench();
  const Anatomy two = with_split_branch(b.anatomy, "main", 0.06, "distal");
  ASSERT_EQ(two.branches.size(), 3U);
  EXPECT_DOUBLE_EQ(find_branch(two, "main")->to_m, 0.06);
  EXPECT_DOUBLE_EQ(find_branch(two, "distal")->from_m, 0.06);
  const Anatomy moved = with_moved_node(two, b.gauge, 0, node_at(two.tubes[0], 0.02), {0.02, 6e-3, 0}, 15e-3);
  const NamedBranch* distal = find_branch(moved, "distal");
  EXPECT_GT(distal->from_m, 0.061) << "the course before it is longer";
  EXPECT_LT((moved.tubes[0].at(distal->from_m).p - Eigen::Vector3d(0.06, 0, 0)).norm(), 0.05e-3);
  EXPECT_DOUBLE_EQ(distal->to_m, moved.tubes[0].length_m());
  EXPECT_EQ(with_name(two, "distal", "OM 2").branches[2].name, "OM 2");
}

TEST(EditAnatomy, AVesselThatWasLeftOutIsFoundAgain) {
  const Bench& b = bench();
  const Anatomy without = without_tube(b.anatomy, 1);
  ASSERT_EQ(without.tubes.size(), 1U);
  ASSERT_EQ(without.branches.size(), 1U);
  const Anatomy again = with_vessel(without, b.wall, {0.0405, 0.0315, 0.001}, "found");
  ASSERT_EQ(again.tubes.size(), 2U);
  EXPECT_EQ(again.tubes[1].parent, 0);
  const NamedBranch* found = find_branch(again, "found");
  ASSERT_TRUE(found);
  const Tube& tube = again.tubes[1];
  EXPECT_NEAR(tube.at(found->from_m).p.y(), 2e-3, 0.5e-3) << "it leaves the wall of its parent there";
  for (double s = found->from_m + 2e-3; s < tube.length_m() - 2e-3; s += 1e-3) {
    const TubeNode at = tube.at(s);
    EXPECT_LT(std::hypot(at.p.x() - 0.04, at.p.z()), 0.25e-3) << s;
    EXPECT_NEAR(at.radius_m, 1.5e-3, 0.15e-3) << s;
  }
  for (const CourseFault& fault : check_courses(again, b.gauge))
    ADD_FAILURE() << static_cast<int>(fault.kind) << " from " << fault.from_m << " to " << fault.to_m << " m of "
                  << again.tubes[static_cast<std::size_t>(fault.tube)].length_m() << ", by " << fault.worst_m;
}

TEST(EditAnatomy, ATubeWithoutParentIsJoined) {
  const Bench& b = bench();
  Anatomy loose = b.anatomy;  // the branch first, and with no parent: its index changes when it gets one
  std::swap(loose.tubes[0], loose.tubes[1]);
  loose.tubes[0].parent = loose.tubes[1].parent = -1;
  for (NamedBranch& branch : loose.branches) branch.tube = 1 - branch.tube;
  const Anatomy joined = with_joined_tube(loose, b.gauge, 0, 1);
  EXPECT_EQ(joined.tubes[0].parent, -1);
  EXPECT_EQ(joined.tubes[1].parent, 0);
  EXPECT_EQ(find_branch(joined, "main")->tube, 0);
  EXPECT_EQ(find_branch(joined, "side")->tube, 1);
  EXPECT_NEAR(joined.tubes[1].at(find_branch(joined, "side")->from_m).p.y(), 2e-3, 0.5e-3);
  EXPECT_TRUE(check_courses(joined, b.gauge).empty());
  EXPECT_NE(refusal([&] { with_joined_tube(joined, b.gauge, 0, 1); }).find("branch of main itself"), std::string::npos);
}

TEST(EditAnatomy, ABranchThatBeginsApartIsAFault) {
  const Bench& b = bench();
  Anatomy apart = b.anatomy;
  std::erase_if(apart.tubes[1].nodes, [](const TubeNode& node) { return node.s_m < 9e-3; });
  const auto faults = check_courses(apart, b.gauge);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].kind, CourseFault::Kind::apart);
  EXPECT_NEAR(faults[0].worst_m, 9e-3 - 3.5e-3, 0.5e-3);
}

TEST(EditAnatomy, WhatCannotBeIsRefused) {
  const Bench& b = bench();
  const auto says = [](const std::string& why, const char* words) {
    EXPECT_NE(why.find(words), std::string::npos) << why << ", not: " << words;
  };
  says(refusal([&] { without_tube(b.anatomy, 0); }), "side leaves main");
  says(refusal([&] { without_tube(without_tube(b.anatomy, 1), 0); }), "only vessel");
  says(refusal([&] { without_tube(b.anatomy, 2); }), "there is no vessel 2");
  says(refusal([&] { with_end(b.anatomy, 0, 0.03); }), "side leaves main farther on");
  says(refusal([&] { with_end(b.anatomy, 0, 0.2); }), "cannot end at 200.0 mm");
  says(refusal([&] { with_end(with_split_branch(b.anatomy, "main", 0.06, "x"), 0, 0.06); }),
       "nothing would be left of x");
  says(refusal([&] { with_name(b.anatomy, "main", "side"); }), "already");
  says(refusal([&] { with_name(b.anatomy, "main", "LAD"); }), "heart");
  says(refusal([&] { with_name(b.anatomy, "main", "a/b"); }), "letters");
  says(refusal([&] { with_name(b.anatomy, "none", "x"); }), "no branch none");
  says(refusal([&] { with_split_branch(b.anatomy, "main", 0.099, "x"); }), "cannot be divided");
  says(refusal([&] { with_vessel(b.anatomy, b.wall, {0.07, 0.002, 0}, "x"); }), "main");
  says(refusal([&] { with_entry(b.anatomy, {0.05, 0.2, 0}); }), "outside");
  says(refusal([&] { with_moved_node(b.anatomy, b.gauge, 0, 9999, {0, 0, 0}, 0); }), "no sphere 9999");
  says(refusal([&] { with_moved_node(b.anatomy, b.gauge, 0, 1, {NAN, 0, 0}, 0); }), "nowhere");
}

TEST(EditAnatomy, AnEntryLiesOnACentrelineAndLooksInwards) {
  const Anatomy entered = with_entry(bench().anatomy, {0.01, 1e-3, 1e-3});
  EXPECT_LT((entered.landmarks.p_access - Eigen::Vector3d(0.01, 0, 0)).norm(), 1e-4);
  EXPECT_NEAR(entered.landmarks.access_direction.x(), 1, 1e-6);
  EXPECT_NEAR(with_end(entered, 0, 0.08).tubes[0].length_m(), 0.08, 1e-9);
}

}  // namespace
}  // namespace ostium::vascular
