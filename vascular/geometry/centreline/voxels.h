#pragma once
/// The inside of a closed mesh as voxels. Used by centreline.cpp.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

class Voxels {
 public:
  /// Inside by the winding number along z, so pieces may overlap; columns that do not come out again (a hole) count as
  /// outside.
  Voxels(const Mesh& mesh, const BoundingVolumeHierarchy& wall, std::size_t most);

  double size_m() const { return size_; }
  int count() const { return static_cast<int>(places_.size()); }
  const Eigen::Vector3d& place(int voxel) const { return places_[static_cast<std::size_t>(voxel)]; }
  double to_wall_m(int voxel) const { return to_wall_[static_cast<std::size_t>(voxel)]; }
  int nearest(const Eigen::Vector3d& p) const;
  /// Visits the inside ones of 26 neighbours, and what it is linked with, with how far they are.
  template <class Visit>
  void neighbours(int voxel, Visit visit) const {
    const long cell = cells_[static_cast<std::size_t>(voxel)];
    for (long z = -1; z <= 1; ++z)
      for (long y = -1; y <= 1; ++y)
        for (long x = -1; x <= 1; ++x) {
          const int next = index_[static_cast<std::size_t>(cell + (z * n_[1] + y) * n_[0] + x)];
          if (next >= 0 && next != voxel) visit(next, size_ * std::sqrt(static_cast<double>(x * x + y * y + z * z)));
        }
    if (links_.empty()) return;
    for (auto [link, end] = links_.equal_range(voxel); link != end; ++link)
      visit(link->second, (place(link->second) - place(voxel)).norm());
  }
  /// The inside ones of a cube of cells about it, 2 `reach` + 1 along a side.
  template <class Visit>
  void around(int voxel, long reach, Visit visit) const {
    const long cell = cells_[static_cast<std::size_t>(voxel)], sheet = n_[0] * n_[1];
    const long at[3] = {cell % n_[0], cell / n_[0] % n_[1], cell / sheet};
    const auto low = [&](int axis) { return std::max(at[axis] - reach, 0L); };
    const auto high = [&](int axis) { return std::min(at[axis] + reach, n_[axis] - 1); };
    for (long z = low(2); z <= high(2); ++z)
      for (long y = low(1); y <= high(1); ++y)
        for (long x = low(0); x <= high(0); ++x)
          if (const int next = index_[static_cast<std::size_t>(z * sheet + y * n_[0] + x)]; next >= 0) visit(next);
  }
  /// Makes two of them neighbours.
  void link(int a, int b) { links_.emplace(a, b), links_.emplace(b, a); }

 private:
  double size_ = 0;
  long n_[3] = {0, 0, 0};
  std::vector<int> index_;  ///< of every cell; -1: outside
  std::vector<long> cells_;
  std::multimap<int, int> links_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<double> to_wall_;
};

}  // namespace ostium::vascular
