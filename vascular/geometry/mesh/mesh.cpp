#include "vascular/geometry/mesh/mesh.h"

#include <Eigen/Geometry>
#include <cmath>
#include <unordered_map>

#include "core/base/units.h"
#include "core/math/solid_angle.h"

namespace ostium::vascular {

namespace {

using Cell = std::array<long, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    // Unsigned, as these products overflow.
    return static_cast<std::size_t>(c[0]) * 73856093 ^ static_cast<std::size_t>(c[1]) * 19349663 ^
           static_cast<std::size_t>(c[2]) * 83492791;
  }
};

Cell cell_of(const Eigen::Vector3d& p, double size) {
  return {std::lround(p.x() / size), std::lround(p.y() / size), std::lround(p.z() / size)};
}

}  // namespace

std::vector<int> weld(const std::vector<Eigen::Vector3d>& corners, double weld_m) {
  const double size = 2 * std::max(weld_m, 1e-12);
  std::unordered_map<Cell, std::vector<int>, CellHash> vertices_in;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_of(corners.size(), -1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Cell low = cell_of(corners[i].array() - weld_m, size), high = cell_of(corners[i].array() + weld_m, size);
    for (long x = low[0]; x <= high[0]; ++x)
      for (long y = low[1]; y <= high[1]; ++y)
        for (long z = low[2]; z <= high[2] && vertex_of[i] < 0; ++z) {
          const auto found = vertices_in.find({x, y, z});
          if (found == vertices_in.end()) continue;
          for (int v : found->second)
            if ((vertices[v] - corners[i]).norm() <= weld_m) vertex_of[i] = v;
        }
    if (vertex_of[i] >= 0) continue;
    vertex_of[i] = static_cast<int>(vertices.size());
    vertices_in[cell_of(corners[i], size)].push_back(vertex_of[i]);
    vertices.push_back(corners[i]);
  }
  return vertex_of;
}

Eigen::Vector3d box_middle(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box.isEmpty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : box.center();
}

double volume_m3(const Mesh& mesh) {
  const Eigen::Vector3d origin = box_middle(mesh);
  double six_volumes = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_volumes += (mesh.vertices[a] - origin).dot((mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin));
  return six_volumes / 6;
}

double winding_number(const Mesh& mesh, const Eigen::Vector3d& p) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += core::solid_angle(mesh.vertices[static_cast<std::size_t>(a)] - p,
                             mesh.vertices[static_cast<std::size_t>(b)] - p,
                             mesh.vertices[static_cast<std::size_t>(c)] - p);
  return sum / (4 * units::pi);
}

double area_m2(const Mesh& mesh) {
  double two_areas = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    two_areas += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  return two_areas / 2;
}

void append(Mesh& a, const Mesh& b) {
  const int first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({first + i, first + j, first + k});
}

}  // namespace ostium::vascular
