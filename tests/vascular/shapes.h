#pragma once
/// Meshes whose volume, openings and crossings are known.
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::test {

inline vascular::Mesh cube(double edge) {
  vascular::Mesh m;
  for (int i = 0; i < 8; ++i) m.vertices.emplace_back(edge * (i & 1), edge * (i >> 1 & 1), edge * (i >> 2 & 1));
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

/// A sphere of 2 n columns and n rows about `centre`.
inline vascular::Mesh sphere(double radius, int n, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  vascular::Mesh m;
  const int columns = 2 * n;
  m.vertices.push_back(centre + radius * Eigen::Vector3d::UnitZ());
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < columns; ++j) {
      const double theta = units::pi * i / n, phi = 2 * units::pi * j / columns;
      m.vertices.push_back(centre + radius * Eigen::Vector3d(std::sin(theta) * std::cos(phi),
                                                             std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  m.vertices.push_back(centre - radius * Eigen::Vector3d::UnitZ());
  const int last = static_cast<int>(m.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
  for (int j = 0; j < columns; ++j) {
    m.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    m.triangles.push_back({last, at(n - 1, j + 1), at(n - 1, j)});
  }
  return m;
}

}  // namespace ostium::test
