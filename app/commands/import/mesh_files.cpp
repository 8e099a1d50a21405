#include "app/commands/import/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/motion/frame_order.h"

namespace ostium::app {

namespace fs = std::filesystem;

std::vector<std::string> numbered_meshes(const std::string& folder) {
  std::map<std::pair<std::string, std::string>, std::map<long, std::string>> rows;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string(), ending = entry.path().extension().string();
    const long number = vascular::number_in_name(entry.path().string());
    if (!entry.is_regular_file() || number < 0) continue;
    if (!vascular::has_mesh_ending(entry.path().string())) continue;
    auto& row = rows[{stem.substr(0, stem.find_last_not_of("0123456789") + 1), ending}];
    const auto [twin, is_new] = row.try_emplace(number, entry.path().string());
    if (!is_new)
      throw vascular::MeshError(fmt::format("{}: has the number of {}; expected a number for each frame, remove one",
                                            entry.path().string(), twin->second));
  }
  const auto longest = std::max_element(rows.begin(), rows.end(),
                                        [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  std::vector<std::string> files;
  if (longest != rows.end())
    for (const auto& [number, file] : longest->second) files.push_back(file);
  return files;
}

vascular::Mesh welded(const vascular::Mesh& raw) {
  const std::vector<int> vertex_of = vascular::weld(raw.vertices, vascular::default_weld_m);
  vascular::Mesh mesh;
  for (std::size_t i = 0; i < raw.vertices.size(); ++i)
    if (vertex_of[i] == static_cast<int>(mesh.vertices.size())) mesh.vertices.push_back(raw.vertices[i]);
  for (const auto& [a, b, c] : raw.triangles)
    if (vertex_of[a] != vertex_of[b] && vertex_of[b] != vertex_of[c] && vertex_of[c] != vertex_of[a])
      mesh.triangles.push_back({vertex_of[a], vertex_of[b], vertex_of[c]});
  return mesh;
}

}  // namespace ostium::app
