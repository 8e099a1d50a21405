#pragma once
/// Checks the numbers that an OFF file begins with: assimp reserves memory for as many vertices as they say.
#include <cstddef>
#include <string>

namespace ostium::vascular {

/// Throws MeshError if the file promises more vertices and faces than it has bytes for. What does not begin with
/// numbers passes; assimp reports it.
void check_off_whole(const std::string& path);

/// Throws MeshError if another number of faces was read than the file promises: assimp leaves out those without corners
/// and those of more than nine.
void check_off_faces(const std::string& path, std::size_t read);

}  // namespace ostium::vascular
