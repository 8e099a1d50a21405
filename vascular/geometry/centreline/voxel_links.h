#pragma once
/// Throats that are finer than the voxels: what lies behind one is a piece of its own among them.
#include "vascular/geometry/centreline/voxels.h"

namespace ostium::vascular {

/// Links pieces of voxels that see each other through the lumen: with the largest, or with one that is linked already.
/// No more than 24 voxels lie between them.
void link_pieces(Voxels& voxels, const BoundingVolumeHierarchy& wall);

}  // namespace ostium::vascular
