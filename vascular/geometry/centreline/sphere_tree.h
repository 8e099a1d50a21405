#pragma once
/// The centreline-sphere tree: spheres fitted into the lumen, grouped in branches (P. Korzeniowski's thesis, 2015,
/// 5.3.4.3). Flow, contrast and measurements use it.
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace ostium::vascular {

struct TreeSphere {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< patient frame, metres
  double radius_m = 0;                          ///< largest sphere about p within the lumen
  double s_m = 0;                               ///< arc length from the branch's first sphere
};

struct TreeBranch {
  std::string name;
  int parent = -1;         ///< branch it leaves, less than its own index; -1: a root
  int parent_sphere = -1;  ///< sphere of the parent nearest to its first
  std::vector<TreeSphere> spheres;
};

struct SphereTree {
  std::vector<TreeBranch> branches;
  std::size_t spheres() const;
};

}  // namespace ostium::vascular
