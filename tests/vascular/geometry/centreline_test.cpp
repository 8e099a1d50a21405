/// Centrelines found in a mesh, compared with those the mesh was made from.
#include "vascular/geometry/centreline/centreline.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/vascular/geometry/damage.h"
#include "tests/vascular/geometry/shapes.h"
#include "vascular/anatomy/anatomy.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {
namespace {

std::vector<Tube> fork() {
  return {make_tube("trunk", -1, {{{0, 0, 0}, 2.4e-3}, {{0.02, 0.004, 0}, 2e-3}, {{0.05, 0, 0.01}, 1.2e-3}}),
          make_tube("branch", 0, {{{0.02, 0.004, 0}, 1.4e-3}, {{0.03, 0.02, 0}, 1.2e-3}, {{0.034, 0.04, 0}, 1e-3}})};
}

/// Largest deviations of a branch's spheres from a tube's line, and of their radii from its radius.
std::pair<double, double> worst(const TreeBranch& branch, const Tube& tube, double from_m, double to_m) {
  double off = 0, radius = 0;
  for (const TreeSphere& sphere : branch.spheres) {
    const double s = nearest_s(tube, sphere.p);
    if (s < from_m || s > to_m) continue;
    off = std::max(off, (sphere.p - tube.at(s).p).norm());
    radius = std::max(radius, std::fabs(sphere.radius_m - tube.at(s).radius_m));
  }
  return {off, radius};
}

TEST(Centreline, OfAForkIsFoundUnasked) {
  const std::vector<Tube> tubes = fork();
  const CentrelineResult found =
      find_centrelines(contour(TubeUnion(tubes)).mesh, {.start = {}, .ends = {}, .most_voxels = 1'500'000});
  ASSERT_EQ(found.tree.branches.size(), 2u);
  const TreeBranch &first = found.tree.branches[0], &second = found.tree.branches[1];
  EXPECT_EQ(second.parent, 0);
  EXPECT_LT((first.spheres.front().p - tubes[0].nodes.front().p).norm(), 3e-3);  // it begins at the wide end
  const bool trunk_first = (first.spheres.back().p - tubes[0].nodes.back().p).norm() < 3e-3;
  const Tube& other = trunk_first ? tubes[1] : tubes[0];
  const auto [off, radius] = worst(second, other, trunk_first ? 4e-3 : 25e-3, other.length_m() - 1e-3);
  EXPECT_LT(off, 0.15e-3);
  EXPECT_LT(radius, 0.15e-3);
  const auto [off_trunk, radius_trunk] = worst(first, tubes[0], 1e-3, 15e-3);
  EXPECT_LT(off_trunk, 0.15e-3);
  EXPECT_LT(radius_trunk, 0.15e-3);
}

/// A throat of 0.6 mm and voxels of 1.1 mm: what lies behind it is another piece of voxels, but of the same lumen.
TEST(Centreline, GoesThroughAThroatThatIsFinerThanItsVoxels) {
  const std::vector<Tube> tubes = {make_tube("throat", -1,
                                             {{{0, 0, 0}, 1.8e-3},
                                              {{0.03, 0.004, 0}, 1.7e-3},
                                              {{0.038, 0.0045, 0}, 0.3e-3},
                                              {{0.04, 0.0045, 0}, 0.3e-3},
                                              {{0.048, 0.004, 0}, 1.6e-3},
                                              {{0.08, 0, 0.01}, 1.4e-3}})};
  const Mesh mesh = contour(TubeUnion(tubes)).mesh;
  for (const double voxel : {0.5e-3, 0.9e-3, 1.1e-3}) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
    const CentrelineResult found = find_centrelines(
        mesh, {.start = {}, .ends = {}, .most_voxels = static_cast<std::size_t>(box.volume() / std::pow(voxel, 3))});
    ASSERT_EQ(found.tree.branches.size(), 1u) << voxel;
    const TreeBranch& branch = found.tree.branches[0];
    EXPECT_NEAR(branch.spheres.back().s_m, tubes[0].length_m() + 1.8e-3 + 1.4e-3, 2e-3) << voxel;  // to the tips
    const auto [off, radius] = worst(branch, tubes[0], 3e-3, tubes[0].length_m() - 3e-3);
    EXPECT_LT(off, 0.25e-3) << voxel;
    EXPECT_LT(radius, 0.15e-3) << voxel;
    EXPECT_NEAR(std::ranges::min_element(branch.spheres, {}, &TreeSphere::radius_m)->radius_m, 0.3e-3, 0.08e-3)
        << voxel;
  }
}

/// Two pieces side by side see each other only through walls.
TEST(Centreline, NoWayLeadsThroughAWall) {
  const Mesh one = contour(TubeUnion({make_tube("", -1, {{{0, 0, 0}, 1.5e-3}, {{0.06, 0, 0}, 1.5e-3}})})).mesh;
  Mesh two = one, other = one;
  for (Eigen::Vector3d& p : other.vertices) p.y() += 4e-3;
  append(two, other);
  const CentrelineResult found = find_centrelines(two, {.start = {}, .ends = {}, .most_voxels = 60'000});
  for (const TreeBranch& branch : found.tree.branches)
    for (const TreeSphere& sphere : branch.spheres)
      EXPECT_NEAR(sphere.p.y(), branch.spheres.front().p.y(), 1e-3) << "a branch stays in its piece";
}

TEST(Centreline, PickedPointsDecide) {
  const std::vector<Tube> tubes = fork();
  const Mesh mesh = contour(TubeUnion(tubes)).mesh;
  const CentrelineResult found = find_centrelines(
      mesh, {.start = tubes[1].nodes.back().p, .ends = {tubes[0].nodes.back().p}, .most_voxels = 1'500'000});
  ASSERT_EQ(found.tree.branches.size(), 1u);
  EXPECT_LT((found.tree.branches[0].spheres.front().p - tubes[1].nodes.back().p).norm(), 1.5e-3);
  EXPECT_LT((found.tree.branches[0].spheres.back().p - tubes[0].nodes.back().p).norm(), 1.5e-3);
}

TEST(Centreline, AllBranchesOfTheLeftCoronaryTree) {
  const Anatomy anatomy = build_anatomy({});
  std::vector<Tube> left;
  const int trunk = find_branch(anatomy, "LM")->tube;
  std::vector<int> index(anatomy.tubes.size(), -1);
  for (std::size_t t = 0; t < anatomy.tubes.size(); ++t) {
    const int parent = anatomy.tubes[t].parent;
    if (static_cast<int>(t) != trunk && (parent < 0 || index[parent] < 0)) continue;
    index[t] = static_cast<int>(left.size());
    left.push_back(anatomy.tubes[t]);
    left.back().parent = static_cast<int>(t) == trunk ? -1 : index[parent];
  }
  const CentrelineResult found = find_centrelines(contour(TubeUnion(left)).mesh);
  EXPECT_EQ(found.tree.branches.size(), left.size());
  int reached = 0;
  for (const Tube& tube : left)
    for (const TreeBranch& branch : found.tree.branches)
      if ((branch.spheres.back().p - tube.nodes.back().p).norm() < 2e-3) {
        ++reached;
        EXPECT_LT(worst(branch, tube, 6e-3, tube.length_m() - 1e-3).first, 0.45e-3) << tube.name;
      }
  EXPECT_EQ(reached, static_cast<int>(left.size()));
  EXPECT_LT((found.tree.branches[0].spheres.front().p - left[0].nodes.front().p).norm(), 4e-3);
}

TEST(Centreline, OfATubeGoesFromLidToLidHoweverItLiesOpenOrClosed) {
  constexpr double radius = 2.5e-3, length = 100e-3;
  for (bool open : {false, true})
    for (int turn = 0; turn < 4; ++turn) {
      Mesh mesh = test::tube(radius, length, 32, 100, open);
      const Eigen::Matrix3d R = Eigen::AngleAxisd(turn == 3 ? 0.7 : turn * units::pi / 2,
                                                  Eigen::Vector3d(turn == 1, turn != 1, turn == 3).normalized())
                                    .matrix();
      for (Eigen::Vector3d& p : mesh.vertices) p = R * p;
      EXPECT_EQ(close_all(mesh).size(), open ? 2u : 0u);
      const CentrelineResult found = find_centrelines(mesh, {.start = {}, .ends = {}, .most_voxels = 200'000});
      ASSERT_EQ(found.tree.branches.size(), 1u);
      const std::vector<TreeSphere>& spheres = found.tree.branches[0].spheres;
      EXPECT_NEAR(spheres.back().s_m, length, 0.2e-3);
      // 32 flat strips are inscribed: 0.5 % narrower.
      for (const TreeSphere& sphere : spheres) {
        EXPECT_NEAR(sphere.radius_m, radius * std::cos(units::pi / 32), 0.01 * radius) << turn << " at " << sphere.s_m;
        EXPECT_LT((R.transpose() * sphere.p).head<2>().norm(), 0.02 * radius) << turn << " at " << sphere.s_m;
      }
    }
}

TEST(Centreline, OfATaperBeginsAtTheWideEndHoweverRough) {
  for (const bool turned : {false, true})
    for (const unsigned seed : {1u, 2u, 3u}) {
      Mesh mesh = test::tube(1.7e-3, 60e-3, 32, 120);
      for (Eigen::Vector3d& p : mesh.vertices) {
        p.head<2>() *= 1 - 0.3 * p.z() / 60e-3;  // 1.7 to 1.2 mm
        if (turned) p = Eigen::Vector3d(p.y(), p.x(), 60e-3 - p.z()), p.x() = -p.x();
      }
      const CentrelineResult found = find_centrelines(test::with_noise(mesh, 0.05e-3, seed));
      ASSERT_EQ(found.tree.branches.size(), 1u);
      const std::vector<TreeSphere>& spheres = found.tree.branches[0].spheres;
      EXPECT_GT(spheres.front().radius_m, spheres.back().radius_m + 0.3e-3) << turned << seed;
      EXPECT_NEAR(spheres.back().s_m, 60e-3, 1e-3);
    }
}

/// Steps towards a lid go by the radius, and here there is none at the end of ever smaller ones.
TEST(Centreline, OfASpikeEnds) {
  Mesh mesh = test::tube(3e-3, 60e-3, 32, 60);
  for (Eigen::Vector3d& p : mesh.vertices) p.head<2>() *= std::max(1e-7, 1 - p.z() / 60e-3);
  const CentrelineResult found = find_centrelines(mesh, {.start = {}, .ends = {}, .most_voxels = 200'000});
  ASSERT_FALSE(found.tree.branches.empty());
  EXPECT_GT(found.tree.branches[0].spheres.back().s_m, 30e-3);
}

TEST(Centreline, OfPiecesThatOverlapRunsThroughBoth) {
  Mesh mesh = test::tube(2e-3, 40e-3, 32, 40), other = mesh;
  for (Eigen::Vector3d& p : other.vertices) p += Eigen::Vector3d(1e-4, 2e-4, 30e-3);
  append(mesh, other);
  const CentrelineResult found = find_centrelines(mesh, {.start = {}, .ends = {}, .most_voxels = 200'000});
  ASSERT_FALSE(found.tree.branches.empty());
  EXPECT_GT(found.tree.branches[0].spheres.back().s_m, 65e-3);
}

TEST(Centreline, WhatHasNoInsideOrIsInPiecesIsRefused) {
  EXPECT_THROW(find_centrelines({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}}, {{0, 1, 2}}}), MeshError);
  Mesh two = test::sphere(0.01, 16);
  append(two, test::sphere(0.01, 16, {0.05, 0, 0}));
  EXPECT_THROW(
      find_centrelines(
          two, {.start = Eigen::Vector3d(0, 0, 0), .ends = {Eigen::Vector3d(0.05, 0, 0)}, .most_voxels = 200'000}),
      MeshError);
}

/// A ring has no ends: its lines have the ring's radius everywhere, and it is said where they end.
TEST(Centreline, OfALoopIsCutOpenAndSaysWhere) {
  constexpr int rows = 120, columns = 24;
  constexpr double radius = 1.5e-3, bend = 15e-3;
  Mesh ring;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double along = 2 * units::pi * i / rows, around = 2 * units::pi * j / columns;
      const double r = bend + radius * std::cos(around);
      ring.vertices.emplace_back(r * std::cos(along), r * std::sin(along), radius * std::sin(around));
      const auto at = [](int row, int column) { return row % rows * columns + column % columns; };
      ring.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      ring.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  for (const bool to_lids : {true, false}) {
    const CentrelineResult found = find_centrelines(ring, {.start = {}, .ends = {}, .to_lids = to_lids});
    ASSERT_EQ(found.cuts.size(), 1u);
    EXPECT_NEAR(found.cuts[0].head<2>().norm(), bend, 1.2 * radius);
    double length = 0;
    for (const TreeBranch& branch : found.tree.branches) {
      length += branch.spheres.back().s_m;
      EXPECT_NEAR(branch.spheres.front().radius_m, radius, 0.3 * radius);
      EXPECT_NEAR(branch.spheres.back().radius_m, radius, 0.3 * radius);
    }
    EXPECT_NEAR(length, 2 * units::pi * bend, 6 * radius);
  }
}

/// A tube from `from` to `to`, with lids.
Mesh piece(double radius, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Mesh mesh = test::tube(radius, (to - from).norm(), 24, 80);
  const Eigen::Quaterniond R = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from);
  for (Eigen::Vector3d& p : mesh.vertices) p = from + R * p;
  return mesh;
}

/// As modelling programs leave them: the wall of each piece goes on within the others, and is none there.
TEST(Centreline, OfPiecesThatCrossIsThatOfTheirUnion) {
  Mesh mesh = piece(2e-3, {0, 0, 0}, {0, 0, 40e-3});
  append(mesh, piece(1.5e-3, {0, 0, 20e-3}, {20e-3, 1e-3, 45e-3}));
  append(mesh, piece(1.2e-3, {0, 0, 30e-3}, {-20e-3, 0, 50e-3}));
  const CentrelineResult found = find_centrelines(mesh);
  ASSERT_EQ(found.tree.branches.size(), 3u);
  EXPECT_TRUE(found.cuts.empty());
  for (const TreeSphere& sphere : found.tree.branches[0].spheres)
    if (sphere.p.z() < 15e-3) {
      EXPECT_NEAR(sphere.radius_m, 2e-3, 0.1e-3);
      EXPECT_LT(sphere.p.head<2>().norm(), 0.15e-3);
    }
}

TEST(Centreline, OfALoopOfPiecesThatCrossIsCutOpenAndSaysWhere) {
  const Eigen::Vector3d corners[] = {{0, 0, 0}, {30e-3, 0, 1e-3}, {15e-3, 26e-3, 2e-3}};
  Mesh mesh = piece(2e-3, {-25e-3, -3e-3, 0}, corners[0]);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % 3], past = 1e-3 * (b - a).normalized();
    append(mesh, piece(1.5e-3, a - past, b + past));
  }
  const CentrelineResult found = find_centrelines(mesh);
  EXPECT_EQ(found.cuts.size(), 1u);
  ASSERT_GE(found.tree.branches.size(), 2u);  // beside these, short ones into the corners where lids stand out
  EXPECT_NEAR(found.tree.branches[0].spheres.back().s_m + found.tree.branches[1].spheres.back().s_m, 25e-3 + 90e-3,
              8e-3);
}

}  // namespace
}  // namespace ostium::vascular
