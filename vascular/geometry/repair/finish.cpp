#include "vascular/geometry/repair/finish.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/remesh/decimate.h"
#include "vascular/geometry/repair/calibre.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr int calibre_stride = 4, most_uncrossings = 12;
constexpr double longest_edge_m = 2.2e-3;
constexpr double chance_voxels = 0.05;  // within this distance, a level set's vertex positions are arbitrary
constexpr double most_turn = 0;         // cosine, of a triangle whose corners move onto the wall
constexpr double least_height = 0.02;   // of a triangle over its longest edge, likewise
constexpr int most_returns = 6;
constexpr double cell_at_1_mm_m = 0.6e-3;  // same as the contour of our own anatomy

bool spoils(const std::array<int, 3>& t, const std::vector<Eigen::Vector3d>& before,
            const std::vector<Eigen::Vector3d>& after) {
  const auto area = [&](const std::vector<Eigen::Vector3d>& p) {
    return Eigen::Vector3d((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]));
  };
  const auto longest2 = [&](const std::vector<Eigen::Vector3d>& p) {
    return std::max(
        {(p[t[1]] - p[t[0]]).squaredNorm(), (p[t[2]] - p[t[1]]).squaredNorm(), (p[t[0]] - p[t[2]]).squaredNorm()});
  };
  const Eigen::Vector3d was = area(before), is = area(after);
  const double height = is.norm() / longest2(after), had = was.norm() / longest2(before);
  return was.dot(is) < most_turn * was.norm() * is.norm() || height < std::min(least_height, 0.5 * had);
}

Eigen::Vector3d twice_area(const Mesh& mesh, const std::array<int, 3>& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

std::vector<Eigen::Vector3d> normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> normal(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& t : mesh.triangles)
    for (int v : t) normal[v] += twice_area(mesh, t);
  for (Eigen::Vector3d& n : normal) n.normalize();
  return normal;
}

/// If a triangle would flip or flatten, its corners move half as far, and finally not at all.
void move_vertices(std::vector<Eigen::Vector3d> step, Mesh& mesh) {
  const std::vector<Eigen::Vector3d> from = mesh.vertices;
  for (int round = 0; round <= most_returns; ++round) {
    for (std::size_t v = 0; v < from.size(); ++v) mesh.vertices[v] = from[v] + step[v];
    std::vector<bool> returns(from.size());
    bool any = false;
    for (const auto& t : mesh.triangles) {
      if (!spoils(t, from, mesh.vertices)) continue;
      any = true;
      for (int v : t) returns[v] = true;
    }
    if (!any) return;
    for (std::size_t v = 0; v < from.size(); ++v)
      if (returns[v]) step[v] *= round + 1 < most_returns ? 0.5 : 0;
  }
}

/// Moves vertices onto the original wall: level set and decimation are off by a fraction of a voxel.
void onto_wall(const BoundingVolumeHierarchy& wall, double voxel_m, Mesh& mesh) {
  // Along the normal only: sideways, vertices would come together where the wall has an edge.
  std::vector<Eigen::Vector3d> step = normals(mesh);
  for (std::size_t v = 0; v < step.size(); ++v) {
    const BoundingVolumeHierarchy::Nearest near = wall.nearest(mesh.vertices[v], voxel_m);
    step[v] *= near.triangle >= 0 ? (near.point - mesh.vertices[v]).dot(step[v]) : 0;
  }
  move_vertices(std::move(step), mesh);
}

/// Triangles whose corners lie on a curved wall cut its inside off. Moves vertices outwards until the wall lies as much
/// inside as outside of the triangles about each: the mean over a triangle of a deviation that grows with the square
/// is that at the middles of its edges.
void astride_wall(const BoundingVolumeHierarchy& wall, double voxel_m, Mesh& mesh) {
  std::vector<double> volume(mesh.vertices.size(), 0), area(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d n = twice_area(mesh, t);
    double deviation = 0;
    int near_edges = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d middle = (mesh.vertices[t[k]] + mesh.vertices[t[(k + 1) % 3]]) / 2;
      const BoundingVolumeHierarchy::Nearest near = wall.nearest(middle, voxel_m);
      if (near.triangle >= 0) deviation += (near.point - middle).dot(n), ++near_edges;
    }
    if (near_edges < 3) continue;
    for (int v : t) volume[v] += deviation / 3, area[v] += n.norm();
  }
  std::vector<Eigen::Vector3d> step = normals(mesh);
  for (std::size_t v = 0; v < step.size(); ++v) step[v] *= area[v] > 0 ? volume[v] / area[v] : 0;
  move_vertices(std::move(step), mesh);
}

std::vector<double> wanted_edges(const Mesh& fine, double voxel_m) {
  const BoundingVolumeHierarchy tree(fine);
  const std::vector<double> diameter = calibres(fine, tree, calibre_stride);
  std::vector<double> edge(fine.vertices.size(), 0);
  std::vector<int> count(fine.vertices.size(), 0);
  for (std::size_t i = 0; i < diameter.size(); ++i) {
    if (diameter[i] <= 0) continue;
    for (int v : fine.triangles[i * calibre_stride]) edge[v] += diameter[i], ++count[v];
  }
  for (std::size_t v = 0; v < edge.size(); ++v)
    if (count[v]) edge[v] /= count[v];
  // Vertices without a sampled triangle take their neighbours' value.
  for (int round = 0; round < 2; ++round)
    for (const auto& t : fine.triangles)
      for (int k = 0; k < 3; ++k)
        if (const int from = t[k], to = t[(k + 1) % 3]; edge[from] > 0 && edge[to] == 0) edge[to] = edge[from];
  for (double& e : edge) {
    const double radius = e > 0 ? e / 2 : mm;
    e = std::clamp(cell_at_1_mm_m * std::pow(radius / mm, 0.75), 1.2 * voxel_m,
                   std::max(longest_edge_m, 1.2 * voxel_m));
  }
  return edge;
}

}  // namespace

void uncross(Mesh& mesh) {
  for (int round = 0; round < most_uncrossings; ++round) {
    const auto pairs = crossing_triangles(mesh);
    if (pairs.empty()) return;
    std::vector<bool> moves(mesh.vertices.size());
    for (const auto& pair : pairs)
      for (int t : pair)
        for (int v : mesh.triangles[t]) moves[v] = true;
    for (int wider = 0; wider <= round / 3; ++wider) {
      const std::vector<bool> before = moves;
      for (const auto& t : mesh.triangles)
        if (before[t[0]] || before[t[1]] || before[t[2]]) moves[t[0]] = moves[t[1]] = moves[t[2]] = true;
    }
    std::vector<Eigen::Vector3d> sum(mesh.vertices.size(), Eigen::Vector3d::Zero());
    std::vector<int> count(mesh.vertices.size(), 0);
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) sum[t[k]] += mesh.vertices[t[(k + 1) % 3]], ++count[t[k]];
    for (std::size_t v = 0; v < moves.size(); ++v)
      if (moves[v]) mesh.vertices[v] = (mesh.vertices[v] + sum[v] / count[v]) / 2;
  }
}

Mesh finished_surface(const Mesh& fine, const BoundingVolumeHierarchy& wall, double voxel_m, std::size_t parts,
                      std::size_t most_triangles) {
  std::vector<double> edge = wanted_edges(fine, voxel_m);
  Mesh mesh = decimate(fine, edge, chance_voxels * voxel_m);
  if (mesh.triangles.size() * parts > most_triangles) {
    const double longer =
        std::sqrt(static_cast<double>(mesh.triangles.size() * parts) / static_cast<double>(most_triangles));
    for (double& e : edge) e *= longer;
    mesh = decimate(fine, edge, chance_voxels * voxel_m);
  }
  onto_wall(wall, voxel_m, mesh);
  astride_wall(wall, voxel_m, mesh);
  uncross(mesh);
  return mesh;
}

}  // namespace ostium::vascular
