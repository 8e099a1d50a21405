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

/// A straight tube along z from 0 to `length`, of `columns` and `rows`; its lids are fans, if it has any.
inline vascular::Mesh tube(double radius, double length, int columns, int rows, bool open = false) {
  vascular::Mesh m;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double phi = 2 * units::pi * j / columns;
      m.vertices.emplace_back(radius * std::cos(phi), radius * std::sin(phi), length * i / rows);
    }
  const auto at = [&](int i, int j) { return i * columns + j % columns; };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      m.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      m.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  if (open) return m;
  const int bottom = static_cast<int>(m.vertices.size()), top = bottom + 1;
  m.vertices.emplace_back(0, 0, 0);
  m.vertices.emplace_back(0, 0, length);
  for (int j = 0; j < columns; ++j) {
    m.triangles.push_back({bottom, at(0, j + 1), at(0, j)});
    m.triangles.push_back({top, at(rows, j), at(rows, j + 1)});
  }
  return m;
}

/// The wall of a straight tube along z as one solid: two surfaces, and rims that join them at both ends.
inline vascular::Mesh wall(double inner_radius, double thickness, double length, int columns, int rows) {
  vascular::Mesh m = tube(inner_radius + thickness, length, columns, rows, true);
  vascular::Mesh inner = tube(inner_radius, length, columns, rows, true);
  for (auto& t : inner.triangles) std::swap(t[1], t[2]);
  const int from = static_cast<int>(m.vertices.size());
  append(m, inner);
  for (int j = 0; j < columns; ++j) {
    const int k = (j + 1) % columns, top = rows * columns;
    m.triangles.push_back({j, from + j, from + k});
    m.triangles.push_back({j, from + k, k});
    m.triangles.push_back({top + j, from + top + k, from + top + j});
    m.triangles.push_back({top + j, top + k, from + top + k});
  }
  return m;
}

/// In single precision, as files have it. Two loops: see as_written.
inline vascular::Mesh in_single(vascular::Mesh m) {
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3d& p : m.vertices) kept.push_back(p.cast<float>());
  for (std::size_t v = 0; v < kept.size(); ++v) m.vertices[v] = kept[v].cast<double>();
  return m;
}

/// Area of a regular polygon with its corners on a circle.
inline double polygon_area(double radius, int corners) {
  return corners * radius * radius * std::sin(2 * units::pi / corners) / 2;
}

}  // namespace ostium::test
