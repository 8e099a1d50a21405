#pragma once
/// Whether triangles cross, in exact arithmetic (CGAL's predicates): the answer depends neither on the order of
/// triangles and corners nor on how the mesh lies.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// True if triangles `s` and `t` of the mesh lie in two planes and a point inside one is inside the other. Touching,
/// with a corner, an edge or a face, is no crossing, and a triangle without area crosses nothing.
bool triangles_cross(const Mesh& mesh, int s, int t);

}  // namespace ostium::vascular
