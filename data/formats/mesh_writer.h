#pragma once
#include <string>

#include "data/formats/write_file.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::data {

/// Writes .obj, .stl or .ply, by the name's ending, in single precision as these formats have it. Throws MeshError for
/// another ending, WriteError.
inline void write_mesh(const std::string& path, const vascular::Mesh& mesh, vascular::LengthUnit unit) {
  write_file(path, mesh_bytes(path, mesh, unit));
}

}  // namespace ostium::data
