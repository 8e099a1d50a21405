#include "vascular/geometry/repair/prolong.h"

#include <algorithm>

namespace ostium::vascular {

namespace {

constexpr double trunk_wider = 4;         // as an aorta compared with its coronary arteries
constexpr double below_ostium_m = 12e-3;  // ostia lie 14 and 17 mm above the annulus (Tops 2008), 3 mm either way
constexpr double most_diameters = 1.5;
constexpr double aside_share = 0.5;  // of the longest gap: sideways distance from the missing part

}  // namespace

std::optional<double> missing_length_m(const CutEnd& cut, const std::vector<VesselEnd>& branches,
                                       double longest_gap_m) {
  double farthest = 0;
  for (const VesselEnd& end : branches) {
    if (!end.origin || cut.radius_m < trunk_wider * end.radius_m) continue;
    const Eigen::Vector3d arm = end.p - cut.middle;
    const double ahead = arm.dot(cut.outwards);
    const Eigen::Vector3d aside = arm - ahead * cut.outwards;
    if (ahead < end.radius_m || ahead > longest_gap_m + end.radius_m ||
        aside.norm() > cut.radius_m + aside_share * longest_gap_m)
      continue;
    farthest = std::max(farthest, ahead);
  }
  if (farthest == 0) return std::nullopt;
  return std::min(farthest + below_ostium_m, most_diameters * 2 * cut.radius_m);
}

Mesh carried_on(const CutEnd& cut, double overlap_m, double length_m) {
  const int n = static_cast<int>(cut.rim.size());
  Mesh mesh;
  for (const double s : {-overlap_m, length_m})
    for (const Eigen::Vector3d& p : cut.rim) {
      const double out = (p - cut.middle).dot(cut.outwards);
      mesh.vertices.push_back(p + (s - (s > 0 ? out : 0)) * cut.outwards);
    }
  for (const double s : {-overlap_m, length_m}) mesh.vertices.push_back(cut.middle + s * cut.outwards);
  // The rim runs in the direction of its opening's half-edges: the wall is to their left, seen from outside.
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    mesh.triangles.push_back({next, k, n + k});
    mesh.triangles.push_back({next, n + k, n + next});
    mesh.triangles.push_back({2 * n, k, next});
    mesh.triangles.push_back({2 * n + 1, n + next, n + k});
  }
  return mesh;
}

}  // namespace ostium::vascular
