#pragma once
/// What people bring as a vessel: a surface, or the centrelines of 3D Slicer with their radii.
#include <string>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::app {

/// As read_mesh; of NAME.mrk.json the surface of the spheres along its curves, in the axes that it says. Throws
/// MeshError, LoadError.
vascular::MeshFile read_vessel(const std::string& path, vascular::LengthUnit unit, double weld_m);

}  // namespace ostium::app
