#include <algorithm>

#include "vascular/geometry/repair/repair.h"
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

std::vector<Mesh> components_of(const Mesh& mesh) {
  const Sheets sheets = sheets_of(mesh);
  std::vector<Mesh> parts(static_cast<std::size_t>(sheets.pieces));
  std::vector<int> index(mesh.vertices.size(), -1), owner(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Mesh& part = parts[sheets.piece[t]];
    std::array<int, 3> renamed;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles[t][k];
      if (owner[v] != sheets.piece[t]) {
        owner[v] = sheets.piece[t];
        index[v] = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      renamed[k] = index[v];
    }
    part.triangles.push_back(renamed);
  }
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t p = 0; p < parts.size(); ++p) order.push_back({-volume_m3(parts[p]), p});
  std::sort(order.begin(), order.end());
  std::vector<Mesh> sorted;
  for (const auto& [volume, p] : order) sorted.push_back(std::move(parts[p]));
  return sorted;
}

}  // namespace ostium::vascular
