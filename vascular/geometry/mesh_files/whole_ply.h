#pragma once
/// Checks that a PLY file is complete: assimp reads whatever is left of a truncated file, and beyond its end.
#include <string>

namespace ostium::vascular {

/// Throws MeshError if the file is shorter than its header promises, or could never hold that much. Lists are assumed
/// to have three entries, as triangles do. Files without a PLY header pass; assimp reports their faults.
void check_ply_whole(const std::string& path);

}  // namespace ostium::vascular
