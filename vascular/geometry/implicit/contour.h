#pragma once
/// Triangulates the surface of a union of tubes: dual contouring of an octree that is refined by local radius (Ju,
/// Losasso, Schaefer, Warren, ACM TOG 2002;21:339); vertices are then moved onto the surface and evened out.
///
/// Level-set libraries contour on a single voxel size, whereas a lumen from 1 to 30 mm needs cells that adapt.
#include "vascular/geometry/implicit/tube.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct ContourSettings {
  double cell_at_1_mm_m = 0.7e-3;  ///< largest cell at 1 mm radius; grows with radius to the power 3/4
  double finest_m = 0.34e-3;       ///< smallest cell, unless the surface needs finer ones; others are 2^n as large
  int relaxations = 3;             ///< rounds of evening out
};

struct Contour {
  Mesh mesh;                                   ///< closed, facing outwards
  std::vector<std::vector<TubeShare>> shares;  ///< of each vertex
};

Contour contour(const TubeUnion& lumen, const ContourSettings& settings = {});

}  // namespace ostium::vascular
