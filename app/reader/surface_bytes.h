#pragma once
/// How a mesh comes out of `ostium-reader`: a word, two numbers, then the corners as they lie in memory. Both ends are
/// one machine.
#include <cstdio>
#include <string>

#include "vascular/geometry/mesh_files/raw_surface.h"

namespace ostium::app {

/// False where not all could be written.
bool write_surface(const vascular::RawSurface& surface, std::FILE* to);

/// Throws data::LoadError that begins with `file` unless the bytes are exactly those of a surface: a reader that a
/// damaged file led astray may have written anything.
vascular::RawSurface surface_of(const std::string& bytes, const std::string& file);

}  // namespace ostium::app
