#pragma once
/// Whether a centreline tree leads everywhere: behind a narrowing that is finer than the grid on which lines are looked
/// for, the lumen goes on without one.
#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct Unreached {
  double share = 0;                             ///< of the surface's vertices, [0, 1]
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< of those the one nearest to a line, m: where the line ends
  std::string branch;                           ///< that ends there; empty: none does
};
/// Vertices farther from every sphere than three of its radii and 1.5 mm; looks at 4,000 of them at most. No spheres:
/// all.
Unreached unreached(const Mesh& lumen, const SphereTree& tree);

/// From this share on somebody should be told.
inline constexpr double unreached_matters = 0.03;

}  // namespace ostium::vascular
