#pragma once
/// Centrelines as 3D Slicer saves them: NAME.mrk.json, a list of curves. Those of its "Extract Centerline" (SlicerVMTK)
/// carry a measurement "Radius" with a value for each control point (Slicer's markups schema, version 1.0.3).
#include <string>
#include <vector>

#include "vascular/geometry/implicit/tube.h"

namespace ostium::data {

/// True for NAME.mrk.json, in whatever case.
bool is_markups_file(const std::string& path);

/// One tube a curve, in LPS, metres; a curve that begins inside an earlier one is its branch. Throws LoadError with
/// file, line and what was expected: also without radii, since they make the vessel.
std::vector<vascular::Tube> load_markups(const std::string& file);
std::vector<vascular::Tube> read_markups(const std::string& file, const std::string& text);

}  // namespace ostium::data
