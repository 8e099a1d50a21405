#pragma once
/// What a file makes of a mesh.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// As the mesh is after `write_mesh` and `read_mesh`: in single precision. What is checked is then what the file holds.
Mesh as_written(Mesh mesh, LengthUnit unit);

}  // namespace ostium::vascular
