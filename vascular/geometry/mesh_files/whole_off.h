#pragma once
/// Checks the numbers that an OFF file begins with: assimp reserves memory for as many vertices as they say.
#include <string>

namespace ostium::vascular {

/// Throws MeshError if the file promises more vertices and faces than it has bytes for. What does not begin with
/// numbers passes; assimp reports it.
void check_off_whole(const std::string& path);

}  // namespace ostium::vascular
