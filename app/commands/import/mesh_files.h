#pragma once
/// Files of meshes as they come, and their vertices joined.
#include <string>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::app {

/// The meshes of a folder that have one name and a number, by the number; of several such rows the longest.
std::vector<std::string> numbered_meshes(const std::string& folder);
/// `raw` (m) with one vertex where several lie within default_weld_m, without the triangles that vanish.
vascular::Mesh welded(const vascular::Mesh& raw);

}  // namespace ostium::app
