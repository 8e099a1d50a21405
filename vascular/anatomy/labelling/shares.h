#pragma once
/// Which tubes decide where a vertex of a given surface goes.
#include "vascular/mesh.h"
#include "vascular/shape/tube.h"

namespace ostium {

/// Of each vertex, as contour gives them for the surfaces it makes. The tubes run through the surface; where it bulges,
/// the nearest counts.
std::vector<std::vector<TubeShare>> shares_of(const Mesh& mesh, const std::vector<Tube>& tubes);

}  // namespace ostium
