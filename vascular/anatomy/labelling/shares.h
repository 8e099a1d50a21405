#pragma once
/// Which tubes determine the motion of each vertex of a given surface.
#include "vascular/geometry/implicit/tube.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Per vertex, like those that contour computes for its own surfaces. The tubes run through the surface; where it
/// bulges, the nearest tube counts.
std::vector<std::vector<TubeShare>> shares_of(const Mesh& mesh, const std::vector<Tube>& tubes);

}  // namespace ostium::vascular
