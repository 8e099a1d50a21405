#include "vascular/geometry/repair/limbs.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

namespace {

constexpr double facing = -0.7;         // cosine between the walls
constexpr double least_way = 20;        // gaps: what is nearer along the surface is the bottom of a fork or of a dent
constexpr std::size_t least_found = 4;  // rays; fewer have met a fault of the mesh
constexpr int most_looked_from = 60'000;

}  // namespace

std::optional<NearLimbs> nearest_limbs(const Mesh& mesh, double within_m) {
  const Sheets sheets = sheets_of(mesh);
  const BoundingVolumeHierarchy tree(mesh);
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<Eigen::Vector3d> middles, normals;
  for (const auto& [a, b, c] : mesh.triangles) {
    middles.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
    normals.push_back((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized());
  }
  std::vector<NearLimbs> found;
  for (int t = 0; t < n; t += 1 + n / most_looked_from) {
    const auto hits = tree.hits(middles[t] + 1e-7 * normals[t], normals[t], within_m);
    if (hits.empty() || sheets.piece[hits[0].triangle] != sheets.piece[t]) continue;
    const double gap_m = hits[0].distance_m;
    if (normals[hits[0].triangle].dot(normals[t]) > facing) continue;
    if (reached_along(sheets, middles, t, hits[0].triangle, least_way * gap_m)) continue;
    found.push_back({gap_m, middles[t] + gap_m / 2 * normals[t]});
  }
  if (found.size() < least_found) return {};
  return *std::min_element(found.begin(), found.end(),
                           [](const NearLimbs& a, const NearLimbs& b) { return a.gap_m < b.gap_m; });
}

}  // namespace ostium::vascular
