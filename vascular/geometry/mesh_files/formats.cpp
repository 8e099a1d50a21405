#include "vascular/geometry/mesh_files/formats.h"

#include <algorithm>
#include <filesystem>

namespace ostium::vascular {

const std::vector<std::string>& mesh_endings() {
  static const std::vector<std::string> endings = {".stl", ".ply",  ".obj", ".vtp", ".vtu", ".vtk", ".off",
                                                   ".glb", ".gltf", ".dae", ".fbx", ".3ds", ".x3d"};
  return endings;
}

std::string listed_mesh_endings() {
  std::string list;
  for (const std::string& ending : mesh_endings()) list += (list.empty() ? "" : ", ") + ending;
  return list;
}

std::string in_lower_case(std::string text) {
  // Not std::tolower, which goes by the locale.
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string ending_of(const std::string& path) {
  return in_lower_case(std::filesystem::path(path).extension().string());
}

bool has_mesh_ending(const std::string& path) {
  return std::ranges::find(mesh_endings(), ending_of(path)) != mesh_endings().end();
}

bool names_mesh(const std::string& path) {
  std::error_code none;
  return has_mesh_ending(path) && !std::filesystem::is_directory(path, none);
}

bool is_utf16(std::string_view beginning) {
  if (beginning.starts_with("\xFF\xFE") || beginning.starts_with("\xFE\xFF")) return true;
  return beginning.size() > 1 && (beginning[0] == '\0') != (beginning[1] == '\0');
}

}  // namespace ostium::vascular
