#pragma once
/// The length unit and the axes that a mesh file says itself: STL, PLY and OBJ have none, so what is written here
/// carries its unit in a comment, "unit mm", and what 3D Slicer writes its axes, "SPACE=LPS".
#include <optional>
#include <string>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// `bytes` of a PLY, OBJ or binary STL file (by `ending`) with the mark.
std::string with_unit_mark(std::string bytes, const std::string& ending, LengthUnit unit);

/// The unit that a file's first lines name: "comment unit mm" in PLY, "# unit mm" in OBJ, "unit mm" where the header of
/// a binary STL begins; "units" and a colon pass too. None if there is no such line, or if the file cannot be read.
std::optional<LengthUnit> unit_mark_of(const std::string& path);

/// Where a file's x, y, z point to by its header or comments (STL, PLY, OBJ), .vtk's title or the field "SPACE" of .vtp
/// and .vtu: "LPS" or "RAS". None if nothing is said there, or if the file cannot be read. Throws MeshError of a .vtp
/// or .vtu that is damaged, and is for a process of its own (app/reader), as read_surface is.
std::optional<std::string> axes_mark_of(const std::string& path);

}  // namespace ostium::vascular
