#include "vascular/geometry/repair/calibre.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace ostium::vascular {

std::vector<double> calibres(const Mesh& mesh, const BoundingVolumeHierarchy& tree, int stride, double farthest_m) {
  std::vector<double> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += static_cast<std::size_t>(stride)) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d area = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    double diameter = 0;
    if (!area.isZero(0)) {
      const Eigen::Vector3d in = -area.normalized();
      const Eigen::Vector3d from = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3 + 1e-7 * in;
      if (const auto hits = tree.hits(from, in, farthest_m); !hits.empty()) diameter = hits.front().distance_m;
    }
    result.push_back(diameter);
  }
  return result;
}

double percentile(std::vector<double> values, double share) {
  std::erase(values, 0.0);
  if (values.empty()) return 0;
  const std::size_t i =
      std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<long>(i), values.end());
  return values[i];
}

double percentile(const std::vector<double>& values, const std::vector<double>& weights, double share) {
  std::vector<std::pair<double, double>> sorted;
  double total = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] > 0) sorted.emplace_back(values[i], weights[i]), total += weights[i];
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const auto& [value, weight] : sorted)
    if ((sum += weight) >= share * total) return value;
  return 0;
}

std::vector<double> areas_m2(const Mesh& mesh, int stride) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += static_cast<std::size_t>(stride)) {
    const auto& [a, b, c] = mesh.triangles[t];
    areas.push_back((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm() / 2);
  }
  return areas;
}

}  // namespace ostium::vascular
