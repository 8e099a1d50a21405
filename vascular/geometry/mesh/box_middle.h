#pragma once
/// An origin for sums over a mesh.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Middle of the bounding box. Volumes are summed about it: about an origin that lies kilometres away, the sums would
/// cancel to nothing but rounding.
Eigen::Vector3d box_middle(const Mesh& mesh);

}  // namespace ostium::vascular
