#pragma once
/// Throats that are finer than the voxels: what lies behind one is a piece of its own among them.
#include "vascular/geometry/centreline/voxels.h"

namespace ostium::vascular {

/// Links pieces of voxels that see each other through the lumen: with the largest in the same surface, or with one that
/// is linked already. No more than 24 voxels lie between them. `wall`: of `outer`.
void link_pieces(const Mesh& outer, const BoundingVolumeHierarchy& wall, Voxels& voxels);

}  // namespace ostium::vascular
