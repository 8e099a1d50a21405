#pragma once
/// The surface of what several closed surfaces hold together: inner walls go, one closed surface around each
/// connected lumen stays (OpenVDB: distances in a narrow band, then its contour).
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// `closed`: pieces that are closed and face outwards, and may overlap. Edges of the result are about `voxel_m` long;
/// what is narrower than two voxels may be lost.
Mesh outer_surface(const Mesh& closed, double voxel_m);

/// Its triangles that have the outside on one side; those that lie inside another piece do not.
std::vector<std::array<int, 3>> bordering_triangles(const Mesh& closed, double step_m);

}  // namespace ostium::vascular
