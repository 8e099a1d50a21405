#pragma once
/// Fewer triangles: short edges collapse, with the place of the new vertex by quadrics (Garland and Heckbert, SIGGRAPH
/// 1997), until edges are as long as asked.
#include "vascular/mesh.h"

namespace ostium {

/// `edge_m[v]`: how long edges at vertex v should become. Closed stays closed; nothing folds.
Mesh decimate(const Mesh& mesh, const std::vector<double>& edge_m);

}  // namespace ostium
