#pragma once
/// Which tubes decide where a vertex of a given surface goes.
#include "vascular/geometry/implicit/tube.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Of each vertex, as contour gives them for the surfaces it makes. The tubes run through the surface; where it bulges,
/// the nearest counts.
std::vector<std::vector<TubeShare>> shares_of(const Mesh& mesh, const std::vector<Tube>& tubes);

}  // namespace ostium::vascular
