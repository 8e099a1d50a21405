/// Which triangles cross, against a solver in whole numbers, and for every order and direction.
#include "vascular/geometry/mesh/crossing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "tests/vascular/geometry/shapes.h"
#include "vascular/geometry/mesh/surface_check.h"

namespace ostium::vascular {
namespace {

using Whole = Eigen::Matrix<long, 3, 1>;
using WholeTriangle = std::array<Whole, 3>;

/// The insides of two triangles that lie in two planes meet, unless one of these directions parts them: the normals of
/// the faces of their Minkowski difference.
bool cross_in_whole_numbers(const WholeTriangle& s, const WholeTriangle& t) {
  const auto edge = [](const WholeTriangle& a, int k) -> Whole { return a[(k + 1) % 3] - a[k]; };
  std::vector<Whole> normals = {edge(s, 0).cross(edge(s, 1)), edge(t, 0).cross(edge(t, 1))};
  if (normals[0].isZero() || normals[1].isZero()) return false;  // no area, no inside
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) normals.push_back(edge(s, i).cross(edge(t, j)));
  return std::ranges::none_of(normals, [&](const Whole& n) {
    const auto [low_s, high_s] = std::minmax({n.dot(s[0]), n.dot(s[1]), n.dot(s[2])});
    const auto [low_t, high_t] = std::minmax({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
    return !n.isZero() && (high_s <= low_t || high_t <= low_s);
  });
}

TEST(Crossing, AsWholeNumbersHaveItInEveryOrder) {
  // On so small a grid, corners, edges and planes of two triangles often coincide.
  std::mt19937 engine(1);
  std::uniform_int_distribution<long> grid(-2, 2);
  int crossing = 0;
  for (int round = 0; round < 20'000; ++round) {
    WholeTriangle s, t;
    for (WholeTriangle* triangle : {&s, &t})
      for (Whole& p : *triangle) p = {grid(engine), grid(engine), grid(engine)};
    Mesh mesh;
    for (const WholeTriangle& triangle : {s, t})
      for (const Whole& p : triangle) mesh.vertices.push_back(0.1 * p.cast<double>());
    const bool expected = cross_in_whole_numbers(s, t);
    crossing += expected;
    for (const std::array<int, 3>& a : {std::array{0, 1, 2}, {1, 2, 0}, {2, 1, 0}})
      for (const std::array<int, 3>& b : {std::array{3, 4, 5}, {5, 3, 4}, {3, 5, 4}}) {
        mesh.triangles = {a, b};
        ASSERT_EQ(triangles_cross(mesh, 0, 1), expected) << round;
        ASSERT_EQ(triangles_cross(mesh, 1, 0), expected) << round;
      }
  }
  EXPECT_GT(crossing, 1'000);
}

TEST(Crossing, NeighboursThatFoldThroughEachOtherDo) {
  // They share the vertex 0; the second passes through the first, or stands on it.
  Mesh mesh{{{0, 0, 0}, {3, -1, 0}, {3, 1, 0}, {2, 0, -1}, {2, 0, 1}, {2, 0, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_TRUE(triangles_cross(mesh, 0, 1));
  mesh.triangles[1] = {0, 5, 4};
  EXPECT_FALSE(triangles_cross(mesh, 0, 1));
  mesh.triangles[1] = {0, 1, 4};
  EXPECT_FALSE(triangles_cross(mesh, 0, 1));
}

Mesh turned(Mesh mesh, const Eigen::Matrix3d& R) {
  for (Eigen::Vector3d& p : mesh.vertices) p = R * p;
  return mesh;
}

TEST(Crossing, AStraightTubeHasNoneHoweverItLies) {
  const Mesh tube = test::tube(2e-3, 120e-3, 32, 120);
  for (int i = 0; i < 24; ++i) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(0.37 * i, Eigen::Vector3d(i % 3, i % 2, 1).normalized()).matrix();
    // In a file's single precision, too, strips of the tube are flat but for rounding.
    EXPECT_TRUE(crossing_triangles(turned(tube, R)).empty()) << i;
    EXPECT_TRUE(crossing_triangles(test::in_single(turned(tube, R))).empty()) << i;
  }
}

/// Pairs of triangles by the numbers they had before they were shuffled.
std::set<std::array<int, 2>> pairs_of(const Mesh& mesh, const std::vector<int>& number) {
  std::set<std::array<int, 2>> pairs;
  for (const auto& [i, j] : crossing_triangles(mesh))
    pairs.insert({std::min(number[i], number[j]), std::max(number[i], number[j])});
  return pairs;
}

TEST(Crossing, TwoTubesCrossInTheSamePairsInEveryOrderAndDirection) {
  const Mesh one = test::tube(2e-3, 40e-3, 24, 30);
  Mesh mesh = one;
  // Straight through the middle of the first, so that edges meet edges.
  Eigen::Matrix3d across;
  across << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  Mesh other = turned(one, across);
  for (Eigen::Vector3d& p : other.vertices) p += Eigen::Vector3d(-20e-3, 0, 20e-3);
  append(mesh, other);
  std::vector<int> number(mesh.triangles.size());
  std::iota(number.begin(), number.end(), 0);
  const std::set<std::array<int, 2>> expected = pairs_of(mesh, number);
  EXPECT_GT(expected.size(), 50u);
  std::mt19937 engine(2);
  for (int round = 0; round < 12; ++round) {
    std::shuffle(number.begin(), number.end(), engine);
    Mesh shuffled;
    for (int t : number) {
      std::array<int, 3> corners = mesh.triangles[t];
      std::shuffle(corners.begin(), corners.end(), engine);
      shuffled.triangles.push_back(corners);
    }
    for (const Eigen::Vector3d& p : mesh.vertices) {
      const Eigen::Vector3d q(p[round % 3], p[(round + 1) % 3], p[(round + 2) % 3]);
      shuffled.vertices.push_back(round % 2 ? Eigen::Vector3d(-q) : q);
    }
    EXPECT_EQ(pairs_of(shuffled, number), expected) << round;
  }
}

}  // namespace
}  // namespace ostium::vascular
