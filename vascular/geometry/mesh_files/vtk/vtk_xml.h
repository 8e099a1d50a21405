#pragma once
/// VTK's XML files, as VMTK, 3D Slicer, SimVascular and ParaView write them: PolyData (.vtp), UnstructuredGrid (.vtu).
#include <string>

#include "vascular/geometry/mesh_files/raw_surface.h"

namespace ostium::vascular {

/// `path` is for messages, `text` the whole file. Throws MeshError.
RawSurface read_vtk_xml(const std::string& path, const std::string& text);

/// The text that stands as `name` beside the surface (its FieldData), or nothing. Throws MeshError.
std::string vtk_xml_field(const std::string& path, const std::string& text, const char* name);

}  // namespace ostium::vascular
