#include "vascular/geometry/mesh/crossing.h"

// Compiles slowly, and with flags of its own (vascular/CMakeLists.txt): nothing else belongs into this file.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace ostium::vascular {

namespace {

using Triangle = std::array<int, 3>;

/// 1 if the vertex `d` lies where the triangle (a, b, c) runs counter-clockwise, -1 on its other side, 0 in its plane.
int side_of(const Mesh& mesh, int a, int b, int c, int d) {
  // In one plane, as is clear without the slow exact arithmetic.
  if (d == a || d == b || d == c || c == a || c == b) return 0;
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [&](int v) {
    const Eigen::Vector3d& p = mesh.vertices[static_cast<std::size_t>(v)];
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

/// Rotates the corners until the first is the only one on its side of the plane of `of`, and returns that side; 0 if
/// the plane does not pass through the triangle's inside.
int rotate_to_lone(const Mesh& mesh, const Triangle& of, Triangle& triangle) {
  Triangle side;
  for (std::size_t k = 0; k < 3; ++k) side[k] = side_of(mesh, of[0], of[1], of[2], triangle[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const int next = side[k] * side[(k + 1) % 3], last = side[k] * side[(k + 2) % 3];
    if (next > 0 || last > 0 || next + last == 0) continue;
    std::rotate(triangle.begin(), triangle.begin() + static_cast<long>(k), triangle.end());
    return side[k];
  }
  return 0;
}

}  // namespace

/// Each triangle cuts the line in which the planes meet, between its two edges at its lone corner; do these intervals
/// overlap? With both lone corners in front of the other triangle, two comparisons tell (Guigue and Devillers, J Graph
/// Tools 2003;8:25).
bool triangles_cross(const Mesh& mesh, int s, int t) {
  Triangle p = mesh.triangles[static_cast<std::size_t>(s)], q = mesh.triangles[static_cast<std::size_t>(t)];
  const int side_of_p = rotate_to_lone(mesh, q, p);
  if (side_of_p == 0) return false;
  const int side_of_q = rotate_to_lone(mesh, p, q);
  if (side_of_q == 0) return false;
  if (side_of_q < 0) std::swap(p[1], p[2]);
  if (side_of_p < 0) std::swap(q[1], q[2]);
  return side_of(mesh, p[0], p[1], q[0], q[1]) < 0 && side_of(mesh, p[0], p[2], q[0], q[2]) > 0;
}

}  // namespace ostium::vascular
