#include "vascular/anatomy/labelling/shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace ostium::vascular {

namespace {

constexpr double cell_m = 6e-3;
constexpr double reach = 1.5, more_m = 3e-3;  // the wall lies within this many radii of its tube plus a margin

long key_of(const Eigen::Vector3d& p) {
  const auto part = [](double x) { return (static_cast<long>(std::floor(x / cell_m)) + (1L << 20)) & 0x1fffff; };
  return part(p.x()) << 42 | part(p.y()) << 21 | part(p.z());
}

}  // namespace

std::vector<std::vector<TubeShare>> shares_of(const Mesh& mesh, const std::vector<Tube>& tubes) {
  const TubeUnion all(tubes);
  std::unordered_map<long, std::vector<int>> near;
  for (int s = 0; s < static_cast<int>(all.segments().size()); ++s) {
    const int tube = all.segments()[s].tube, node = all.segments()[s].node;
    const TubeNode &a = tubes[tube].nodes[node], &b = tubes[tube].nodes[node + 1];
    const double wide = reach * std::max(a.radius_m, b.radius_m) + more_m;
    const Eigen::Vector3d low = a.p.cwiseMin(b.p).array() - wide, high = a.p.cwiseMax(b.p).array() + wide;
    for (double x = low.x(); x < high.x() + cell_m; x += cell_m)
      for (double y = low.y(); y < high.y() + cell_m; y += cell_m)
        for (double z = low.z(); z < high.z() + cell_m; z += cell_m) {
          std::vector<int>& here = near[key_of({x, y, z})];
          if (here.empty() || here.back() != s) here.push_back(s);
        }
  }
  std::vector<int> every(all.segments().size());
  std::iota(every.begin(), every.end(), 0);
  std::vector<std::vector<TubeShare>> shares(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto found = near.find(key_of(mesh.vertices[v]));
    all.value(mesh.vertices[v], found == near.end() ? every : found->second, nullptr, &shares[v]);
  }
  return shares;
}

}  // namespace ostium::vascular
