#pragma once
/// What a mesh in text may have lost where its last line has no end.
#include <string>

namespace ostium::vascular {

/// A word of doubt about such a file: cut within its last number it is still read, as another mesh. Else empty, as for
/// what is no text (PLY, OBJ, OFF and legacy VTK are looked at; STL has an end of its own).
std::string doubt_of_mesh_end(const std::string& path);

}  // namespace ostium::vascular
