#pragma once
/// VTK's legacy files (.vtk), ASCII or BINARY, versions 1 to 5.1.
#include <string>

#include "vascular/geometry/mesh_files/raw_surface.h"

namespace ostium::vascular {

/// `path` is for messages, `text` the whole file. Throws MeshError.
RawSurface read_vtk_legacy(const std::string& path, const std::string& text);

}  // namespace ostium::vascular
