#pragma once
/// Which formats of meshes are read. The ending decides, in upper or lower case.
#include <string>
#include <string_view>
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
/// The same, and no folder: a case's may be called anything.
bool names_mesh(const std::string& path);
/// Whether a text that begins so is UTF-16, which editors and shells of Windows write unless told otherwise: by its
/// mark, or by a letter of ASCII.
bool is_utf16(std::string_view beginning);
inline constexpr const char* utf16_cure =
    "is UTF-16; save it as UTF-8 (Notepad: Save as, Encoding UTF-8; PowerShell: Out-File -Encoding utf8)";

}  // namespace ostium::vascular
