#pragma once
/// The last step of the repair: a fine surface becomes one for use.
#include "vascular/box_tree.h"

namespace ostium {

/// With edges as long as the calibre asks, at most `most_triangles` over all `parts` lumens, vertices on the `wall`
/// that was given, without crossings.
Mesh finished_surface(const Mesh& fine, const BoxTree& wall, double voxel_m, std::size_t parts,
                      std::size_t most_triangles);

}  // namespace ostium
