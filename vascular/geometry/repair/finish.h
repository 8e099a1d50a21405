#pragma once
/// Last step of the repair: reduces a fine surface to one for use.
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

/// Edge lengths follow the calibre; at most `most_triangles` over all `parts` lumens; vertices lie on the given `wall`;
/// no crossings.
Mesh finished_surface(const Mesh& fine, const BoundingVolumeHierarchy& wall, double voxel_m, std::size_t parts,
                      std::size_t most_triangles);

/// Smooths a surface where triangles cross until none do.
void uncross(Mesh& mesh);

}  // namespace ostium::vascular
