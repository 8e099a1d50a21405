#pragma once
/// The surface of a union of tubes as triangles: dual contouring of an octree that is as fine as the local radius asks
/// (Ju, Losasso, Schaefer, Warren, ACM TOG 2002;21:339), vertices then moved onto the surface and spread out evenly.
///
/// Why not a level-set library: those contour on one voxel size, and a lumen that goes from 1 to 30 mm needs cells that
/// follow it.
#include "vascular/geometry/implicit/tube.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct ContourSettings {
  double cell_at_1_mm_m = 0.7e-3;  ///< largest cell at a radius of 1 mm; grows with the radius to the power 3/4
  double finest_m = 0.34e-3;  ///< no cell is smaller, except where the surface asks for it; the others are 2^n as large
  int relaxations = 3;        ///< rounds of evening out the triangles
};

struct Contour {
  Mesh mesh;                                   ///< closed, facing outwards
  std::vector<std::vector<TubeShare>> shares;  ///< of each vertex
};

Contour contour(const TubeUnion& lumen, const ContourSettings& settings = {});

}  // namespace ostium::vascular
