#pragma once
/// A tube of one calibre along an arc, with flat lids or open.
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::test {

struct BentTube {
  double length = 0, diameter = 0, bend_radius = 0;  ///< of the middle line, in whatever unit
  bool lids = true;
};

inline vascular::Mesh mesh_of(const BentTube& tube) {
  constexpr int columns = 32;
  const int rows = std::max(20, static_cast<int>(6 * tube.length / tube.diameter));
  vascular::Mesh m;
  for (int i = 0; i < rows; ++i) {
    const double a = tube.length / tube.bend_radius * i / (rows - 1);
    const Eigen::Vector3d out(std::cos(a), -std::sin(a), 0), middle(tube.bend_radius, 0, 0);
    for (int j = 0; j < columns; ++j) {
      const double t = 2 * units::pi * j / columns;
      m.vertices.push_back(middle - tube.bend_radius * out + tube.diameter / 2 * std::cos(t) * out +
                           tube.diameter / 2 * std::sin(t) * Eigen::Vector3d::UnitZ());
    }
  }
  const auto at = [](int i, int j) { return i * columns + j % columns; };
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      m.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  for (int end : {0, rows - 1}) {
    if (!tube.lids) break;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int j = 0; j < columns; ++j) middle += m.vertices[static_cast<std::size_t>(at(end, j))] / columns;
    const int centre = static_cast<int>(m.vertices.size());
    m.vertices.push_back(middle);
    for (int j = 0; j < columns; ++j)
      m.triangles.push_back(end ? std::array{at(end, j + 1), at(end, j), centre}
                                : std::array{at(end, j), at(end, j + 1), centre});
  }
  return m;
}

}  // namespace ostium::test
