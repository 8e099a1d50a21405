#include "vascular/geometry/implicit/contour.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

#include "core/base/parallel_loop.h"
#include "vascular/geometry/implicit/contour_octree.h"
#include "vascular/geometry/mesh/surface_check.h"

namespace ostium::vascular {

namespace {

using Near = std::vector<const std::vector<int>*>;  // per vertex: segments that determine the surface there

constexpr double least_cosine = 0.3;  // between a triangle's normal and the surface's
constexpr int most_refinements = 12;
constexpr int most_attempts = 4;

/// Moves vertices along the surface towards the mean of their neighbours.
void even_out(const TubeUnion& lumen, const Near& near, const std::vector<Quad>& quads,
              std::vector<Eigen::Vector3d>& vertices, std::vector<Eigen::Vector3d>& outwards) {
  const std::size_t n = vertices.size();
  std::vector<Eigen::Vector3d> sum(n, Eigen::Vector3d::Zero());
  std::vector<double> weight(n, 0);
  for (const Quad& quad : quads)
    for (int k = 0; k < 4; ++k) {
      const int i = quad[k], j = quad[(k + 1) % 4];
      if (i == j) continue;
      sum[i] += vertices[j], weight[i] += 1;
      sum[j] += vertices[i], weight[j] += 1;
    }
  core::in_parallel(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector3d move = 0.5 * (sum[i] / weight[i] - vertices[i]);
      move -= move.dot(outwards[i]) * outwards[i];
      vertices[i] = onto_surface(lumen, *near[i], vertices[i] + move, 1, outwards[i]);
    }
  });
}

/// Number of faces per edge.
class Edges {
 public:
  template <class Faces>
  Edges(std::size_t vertices, const Faces& faces) : first_(vertices + 1, 0) {
    for_edges(faces, [&](int low, int) { ++first_[low + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    others_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for_edges(faces, [&](int low, int high) { others_[next[low]++] = high; });
  }
  long count(int i, int j) const {
    const int low = std::min(i, j);
    return std::count(others_.begin() + first_[low], others_.begin() + first_[low + 1], std::max(i, j));
  }
  /// visit(i, j), i < j, of each face's edges.
  template <class Faces, class Visit>
  static void for_edges(const Faces& faces, Visit&& visit) {
    for (const auto& face : faces)
      for (std::size_t k = 0; k < face.size(); ++k) {
        const int i = face[k], j = face[(k + 1) % face.size()];
        visit(std::min(i, j), std::max(i, j));
      }
  }

 private:
  std::vector<int> first_, others_;  ///< per vertex: higher-numbered vertices that share an edge with it
};

/// Splits each quadrilateral along its shorter diagonal, unless that edge already exists.
std::vector<std::array<int, 3>> split(const std::vector<Quad>& quads, const std::vector<Eigen::Vector3d>& vertices) {
  const Edges edges(vertices.size(), quads);
  const auto there = [&](int i, int j) { return edges.count(i, j) > 0; };
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(2 * quads.size());
  for (Quad q : quads) {
    if (q[0] != q[1] && q[1] != q[2] && q[2] != q[3] && q[3] != q[0]) {
      const bool shorter = (vertices[q[1]] - vertices[q[3]]).norm() < (vertices[q[0]] - vertices[q[2]]).norm();
      const bool first = there(q[0], q[2]), second = there(q[1], q[3]);
      if (first != second ? first : shorter) std::rotate(q.begin(), q.begin() + 1, q.end());
    }
    for (const std::array<int, 3>& t : {std::array<int, 3>{q[0], q[1], q[2]}, std::array<int, 3>{q[0], q[2], q[3]}})
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  return triangles;
}

/// Vertices where the contour is not a surface or is folded, plus their neighbours (otherwise the jump in cell size
/// would only move the fault): cells are too coarse there. Checking for crossings takes as long as everything else.
std::vector<int> faulty(const Mesh& mesh, const std::vector<Eigen::Vector3d>& outwards, bool crossings) {
  std::vector<bool> fault(mesh.vertices.size()), near_fault(mesh.vertices.size());
  const Edges edges(mesh.vertices.size(), mesh.triangles);
  Edges::for_edges(mesh.triangles, [&](int i, int j) {
    if (edges.count(i, j) > 2) fault[i] = fault[j] = true;
  });
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized();
    if (std::min({normal.dot(outwards[a]), normal.dot(outwards[b]), normal.dot(outwards[c])}) < least_cosine)
      fault[a] = fault[b] = fault[c] = true;
  }
  if (crossings)
    for (const auto& pair : crossing_triangles(mesh))
      for (int t : pair)
        for (int v : mesh.triangles[t]) fault[v] = true;
  for (const auto& [a, b, c] : mesh.triangles)
    if (fault[a] || fault[b] || fault[c]) near_fault[a] = near_fault[b] = near_fault[c] = true;
  std::vector<int> result;
  for (std::size_t v = 0; v < near_fault.size(); ++v)
    if (near_fault[v]) result.push_back(static_cast<int>(v));
  return result;
}

}  // namespace

Contour contour(const TubeUnion& lumen, const ContourSettings& settings) {
  Contour result;
  Mesh& mesh = result.mesh;
  Near near;
  std::vector<Eigen::Vector3d> outwards;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    ContourOctree tree(lumen, settings, 0.37 * attempt);
    bool sound = false;
    for (int round = 0; round < most_refinements && !sound; ++round) {
      const std::vector<Quad> quads = tree.extract(mesh.vertices, outwards, near);
      mesh.triangles = split(quads, mesh.vertices);
      std::vector<int> faults = faulty(mesh, outwards, false);
      if (faults.empty()) {
        for (int i = 0; i < settings.relaxations; ++i) even_out(lumen, near, quads, mesh.vertices, outwards);
        mesh.triangles = split(quads, mesh.vertices);
        faults = faulty(mesh, outwards, true);
      }
      sound = faults.empty();
      if (!sound && !tree.refine(faults)) break;
    }
    if (!sound && attempt + 1 < most_attempts) continue;
    result.shares.resize(mesh.vertices.size());
    core::in_parallel(mesh.vertices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) lumen.value(mesh.vertices[i], *near[i], nullptr, &result.shares[i]);
    });
    break;
  }
  return result;
}

}  // namespace ostium::vascular
