#pragma once
/// Which formats of meshes are read. The ending decides, in upper or lower case.
#include <string>
#include <vector>

namespace ostium::vascular {

/// Endings of meshes that are read, in lower case with their dot; no other file is tried.
const std::vector<std::string>& mesh_endings();
/// ".stl, .ply, ...", for messages.
std::string listed_mesh_endings();

/// Letters of ASCII only.
std::string in_lower_case(std::string text);
/// A file's ending in lower case with its dot; empty if it has none.
std::string ending_of(const std::string& path);
bool has_mesh_ending(const std::string& path);

}  // namespace ostium::vascular
