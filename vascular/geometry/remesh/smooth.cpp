#include "vascular/geometry/remesh/smooth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

constexpr double inwards = 0.5, outwards = -0.53;

/// Neighbours of each vertex, in order; empty at open or branching edges.
std::vector<std::vector<int>> rings(const Mesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  std::vector<std::vector<int>> ring(mesh.vertices.size());
  std::vector<bool> border(mesh.vertices.size());
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    if (j - i != 2) border[edges[i][0]] = border[edges[i][1]] = true;
    ring[edges[i][0]].push_back(edges[i][1]);
    ring[edges[i][1]].push_back(edges[i][0]);
  }
  for (std::size_t v = 0; v < ring.size(); ++v)
    if (border[v]) ring[v].clear();
  return ring;
}

std::vector<Eigen::Vector3d> towards_neighbours(const Mesh& mesh, const std::vector<std::vector<int>>& ring) {
  std::vector<Eigen::Vector3d> step(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t v = 0; v < ring.size(); ++v) {
    if (ring[v].empty()) continue;
    for (int n : ring[v]) step[v] += mesh.vertices[n];
    step[v] = step[v] / static_cast<double>(ring[v].size()) - mesh.vertices[v];
  }
  return step;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

Roughness roughness(const Mesh& mesh) {
  const std::vector<std::vector<int>> ring = rings(mesh);
  const std::vector<Eigen::Vector3d> step = towards_neighbours(mesh, ring);
  std::vector<Eigen::Vector3d> normal(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d area = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    for (int v : {a, b, c}) normal[v] += area;
  }
  std::vector<double> height, edges;
  for (std::size_t v = 0; v < ring.size(); ++v) {
    if (ring[v].empty() || normal[v].isZero(0)) continue;
    // A curved surface also deviates, but so do its neighbours, by the same amount.
    double mean = 0, edge = 0;
    for (int n : ring[v]) {
      mean += step[n].dot(normal[v].normalized());
      edge += (mesh.vertices[n] - mesh.vertices[v]).norm();
    }
    const double n = static_cast<double>(ring[v].size());
    const double out = std::fabs(step[v].dot(normal[v].normalized()) - mean / n);
    height.push_back(out);
    edges.push_back(edge / n);
  }
  return {median(height), median(edges)};
}

void smooth(Mesh& mesh, int rounds) {
  const std::vector<std::vector<int>> ring = rings(mesh);
  for (int round = 0; round < rounds; ++round)
    for (double share : {inwards, outwards}) {
      const std::vector<Eigen::Vector3d> step = towards_neighbours(mesh, ring);
      for (std::size_t v = 0; v < ring.size(); ++v) mesh.vertices[v] += share * step[v];
    }
}

}  // namespace ostium::vascular
