#pragma once
/// The inside of a closed mesh as voxels. Used by centreline.cpp.
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
  /// Visits the inside ones of 26 neighbours.
  template <class Visit>
  void neighbours(int voxel, Visit visit) const {
    const long cell = cells_[static_cast<std::size_t>(voxel)];
    for (long z = -1; z <= 1; ++z)
      for (long y = -1; y <= 1; ++y)
        for (long x = -1; x <= 1; ++x) {
          const int next = index_[static_cast<std::size_t>(cell + (z * n_[1] + y) * n_[0] + x)];
          if (next >= 0 && next != voxel) visit(next, size_ * std::sqrt(static_cast<double>(x * x + y * y + z * z)));
        }
  }

 private:
  double size_ = 0;
  long n_[3] = {0, 0, 0};
  std::vector<int> index_;  ///< of every cell; -1: outside
  std::vector<long> cells_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<double> to_wall_;
};

}  // namespace ostium::vascular
