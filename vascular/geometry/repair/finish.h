#pragma once
/// The last step of the repair: a fine surface becomes one for use.
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

/// With edges as long as the calibre asks, at most `most_triangles` over all `parts` lumens, vertices on the `wall`
/// that was given, without crossings.
Mesh finished_surface(const Mesh& fine, const BoundingVolumeHierarchy& wall, double voxel_m, std::size_t parts,
                      std::size_t most_triangles);

}  // namespace ostium::vascular
