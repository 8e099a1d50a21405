#pragma once
/// Fewer triangles: short edges collapse, with the place of the new vertex by quadrics (Garland and Heckbert, SIGGRAPH
/// 1997), until edges are as long as asked.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// `edge_m[v]`: how long edges at vertex v should become. Closed stays closed; nothing folds. Edges shorter than
/// `chance_m`, within which the mesh does not know where its vertices are, go whatever the triangles beside them
/// become: a level set has some of no length, and slivers side by side would keep each other.
Mesh decimate(const Mesh& mesh, const std::vector<double>& edge_m, double chance_m);

}  // namespace ostium::vascular
