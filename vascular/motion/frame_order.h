#pragma once
/// Whether surfaces that are given as the frames of one beat look like a whole one.
#include <string>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// The number at the end of a file's name before its ending; -1: there is none, or it is too long to be one.
long number_in_name(const std::string& file);

/// What looks wrong, in words: frames out of the order of their numbers, one that is missing or there twice, a jump, as
/// from the last back to the first of half a beat. `files`: of each frame, in the order given, with the same vertices.
std::vector<std::string> doubts_of_frames(const std::vector<Mesh>& frames, const std::vector<std::string>& files);

}  // namespace ostium::vascular
