#pragma once
/// The unit of a mesh that somebody brings, and whether it can be a vessel in it.
#include <string>

#include "vascular/geometry/repair/units.h"

namespace ostium::app {

/// Of a mesh that makes no vessel in any unit, by the lumen inside it if it is a wall. `raw`: the file's numbers taken
/// as metres.
vascular::UnitGuess guess_lumen_unit(const vascular::Mesh& raw);

/// Replaces the guessed unit, and converts the mesh's measurements to it.
void take_unit(vascular::LengthUnit unit, vascular::UnitGuess& guess);

/// Throws MeshError if the mesh is larger than any body.
void require_size(const std::string& file, const vascular::UnitGuess& guess);

}  // namespace ostium::app
