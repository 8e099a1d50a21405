#pragma once
/// Outer surface of the union of several closed surfaces: inner walls vanish, one closed surface per connected lumen
/// remains (OpenVDB: narrow-band distances, then contouring).
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// `closed`: pieces that are closed and face outwards, and may overlap. Edges of the result are about `voxel_m` long;
/// features narrower than two voxels may be lost.
Mesh outer_surface(const Mesh& closed, double voxel_m);

}  // namespace ostium::vascular
