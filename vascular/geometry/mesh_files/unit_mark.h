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

/// Where a file's x, y, z point to by its header or comments: "LPS" or "RAS" (STL, PLY, OBJ, and .vtk's title). None if
/// nothing is said there, or if the file cannot be read.
std::optional<std::string> axes_mark_of(const std::string& path);

}  // namespace ostium::vascular
