#pragma once
/// A mesh as it is after being written to a file.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// As `read_mesh` reads what `mesh_bytes` made, in single precision, so that a check applies to the file's contents.
Mesh as_written(Mesh mesh, LengthUnit unit);

}  // namespace ostium::vascular
