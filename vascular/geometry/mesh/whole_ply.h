#pragma once
/// Whether a PLY file is all there: assimp reads what is left of one that was cut short, and more behind its end.
#include <string>

namespace ostium::vascular {

/// Throws MeshError if the file ends before what its header promises. Lists are taken to be of three, as triangles are:
/// what is cut shorter than that is found. Files without a header of PLY pass; assimp says what is wrong with them.
void check_ply_whole(const std::string& path);

}  // namespace ostium::vascular
