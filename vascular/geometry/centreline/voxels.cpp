#include "vascular/geometry/centreline/voxels.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ostium::vascular {

Voxels::Voxels(const Mesh& mesh, const BoundingVolumeHierarchy& wall, std::size_t most) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  // A compact mesh would fill the box: at most 300,000 voxels inside.
  constexpr double most_inside = 3e5;
  size_ = std::cbrt(std::max(box.volume() / static_cast<double>(most), std::fabs(volume_m3(mesh)) / most_inside));
  // Offset from the grid of the mesh's own coordinates, so that no ray runs along an edge.
  const Eigen::Vector3d origin = box.min() - size_ * Eigen::Vector3d(2.137, 2.271, 2.313);
  for (int axis = 0; axis < 3; ++axis) n_[axis] = static_cast<long>(box.sizes()[axis] / size_) + 6;
  struct Crossing {
    float z;
    int enters;  ///< 1 into the surface, -1 out of it
  };
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(n_[0] * n_[1]));
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = (mesh.vertices[i] - origin) / size_, b = (mesh.vertices[j] - origin) / size_,
                          c = (mesh.vertices[k] - origin) / size_;
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (area == 0) continue;
    const auto low = [&](int axis) { return static_cast<long>(std::ceil(std::min({a[axis], b[axis], c[axis]}))); };
    const auto high = [&](int axis) { return static_cast<long>(std::floor(std::max({a[axis], b[axis], c[axis]}))); };
    for (long y = low(1); y <= high(1); ++y)
      for (long x = low(0); x <= high(0); ++x) {
        const double X = static_cast<double>(x), Y = static_cast<double>(y);
        const double u = ((b.x() - X) * (c.y() - Y) - (b.y() - Y) * (c.x() - X)) / area;
        const double v = ((c.x() - X) * (a.y() - Y) - (c.y() - Y) * (a.x() - X)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        crossings[static_cast<std::size_t>(y * n_[0] + x)].push_back(
            {static_cast<float>(u * a.z() + v * b.z() + (1 - u - v) * c.z()), area < 0 ? 1 : -1});
      }
  }
  index_.assign(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]), -1);
  for (long column = 0; column < n_[0] * n_[1]; ++column) {
    std::vector<Crossing>& z = crossings[static_cast<std::size_t>(column)];
    int winding = 0;
    for (const Crossing& crossing : z) winding += crossing.enters;
    if (winding != 0) continue;
    std::sort(z.begin(), z.end(),
              [](const Crossing& a, const Crossing& b) { return std::tie(a.z, b.enters) < std::tie(b.z, a.enters); });
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      if ((winding += z[i].enters) == 0) continue;
      for (long k = static_cast<long>(std::ceil(z[i].z)); static_cast<float>(k) < z[i + 1].z; ++k) {
        const long cell = k * n_[0] * n_[1] + column;
        if (index_[static_cast<std::size_t>(cell)] >= 0) continue;
        index_[static_cast<std::size_t>(cell)] = count();
        cells_.push_back(cell);
        places_.push_back(origin + size_ * Eigen::Vector3d(static_cast<double>(column % n_[0]),
                                                           static_cast<double>(column / n_[0]),
                                                           static_cast<double>(k)));
        to_wall_.push_back(wall.nearest(places_.back(), 1).distance_m);
      }
    }
  }
}

int Voxels::nearest(const Eigen::Vector3d& p) const {
  int best = -1;
  for (int v = 0; v < count(); ++v)
    if (best < 0 || (place(v) - p).squaredNorm() < (place(best) - p).squaredNorm()) best = v;
  return best;
}

}  // namespace ostium::vascular
