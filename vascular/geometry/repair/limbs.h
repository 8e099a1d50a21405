#pragma once
/// Limbs of one vessel that lie side by side, as those of a hairpin or the turns of a coil: voxels as wide as the gap
/// between them would make one lumen of both.
#include <optional>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct NearLimbs {
  double gap_m = 0;  ///< between their walls
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
};

/// The nearest limbs of one piece, if they come nearer than `within_m`: walls that face each other outwards and lie far
/// apart along the surface, unlike those of a fork beside its carina. `mesh`: closed, facing outwards.
std::optional<NearLimbs> nearest_limbs(const Mesh& mesh, double within_m);

}  // namespace ostium::vascular
