#pragma once
/// Mesh decimation: short edges collapse, new vertices are placed by quadrics (Garland and Heckbert, SIGGRAPH 1997),
/// until edges have the requested length.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// `edge_m[v]`: requested edge length at vertex v. A closed mesh stays closed and does not fold. Edges shorter than
/// `chance_m`, the mesh's positional noise, collapse whatever happens to adjacent triangles: a level set has some of
/// zero length, and neighbouring slivers would block each other for ever.
Mesh decimate(const Mesh& mesh, const std::vector<double>& edge_m, double chance_m);

}  // namespace ostium::vascular
