#pragma once
/// Checks that an STL file is complete: assimp takes what is left of a text that was cut behind a facet, and says of a
/// cut binary file only that it does not know it.
#include <string>

namespace ostium::vascular {

/// Throws MeshError if a binary file holds another number of triangles than its header promises, or if a text does not
/// end with "endsolid". What is neither passes; assimp reports it.
void check_stl_whole(const std::string& path);

/// The text of a file of which some words are in capitals, in small letters, as assimp knows no others; else empty.
std::string stl_in_capitals(const std::string& path);

}  // namespace ostium::vascular
