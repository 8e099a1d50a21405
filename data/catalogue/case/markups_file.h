#pragma once
/// Centrelines as 3D Slicer saves them: NAME.mrk.json, a list of curves. Those of its "Extract Centerline" (SlicerVMTK)
/// carry a measurement "Radius" with a value for each control point (Slicer's markups schema, version 1.0.3).
#include <string>
#include <vector>

#include "vascular/geometry/implicit/tube.h"

namespace ostium::data {

/// True for NAME.mrk.json, in whatever case.
bool is_markups_file(const std::string& path);

struct Markups {
  std::vector<vascular::Tube> tubes;  ///< one a curve, in the file's axes, metres
  std::string axes;                   ///< where these point to: "LPS", or "RAS"
};

/// A curve that begins inside an earlier one is its branch. Throws LoadError with file, line and what was expected:
/// also without radii, since they make the vessel.
Markups load_markups(const std::string& file);
Markups read_markups(const std::string& file, const std::string& text);

}  // namespace ostium::data
