#pragma once
/// The surface of what several closed surfaces hold together: inner walls go, one closed surface around each
/// connected lumen stays (OpenVDB: distances in a narrow band, then its contour).
#include "vascular/mesh.h"

namespace ostium {

/// `closed`: pieces that are closed and face outwards, and may overlap. Edges of the result are about `voxel_m` long;
/// what is narrower than two voxels may be lost.
Mesh outer_surface(const Mesh& closed, double voxel_m);

}  // namespace ostium
