#pragma once
/// Typical damage of clinical meshes, applied to an intact one.
#include <Eigen/Geometry>
#include <random>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::test {

inline Eigen::Vector3d middle_of(const vascular::Mesh& m, const std::array<int, 3>& t) {
  return (m.vertices[t[0]] + m.vertices[t[1]] + m.vertices[t[2]]) / 3;
}

/// Removes everything between two planes across `along`, `width_m` apart, within `reach_m` of `p`, and triangles that
/// they cut.
inline vascular::Mesh with_gap(vascular::Mesh m, const Eigen::Vector3d& p, const Eigen::Vector3d& along, double width_m,
                               double reach_m) {
  std::erase_if(m.triangles, [&](const std::array<int, 3>& t) {
    const Eigen::Vector3d arm = middle_of(m, t) - p;
    return arm.norm() < reach_m && std::fabs(arm.dot(along)) < width_m / 2;
  });
  return m;
}

/// Removes every n-th triangle.
inline vascular::Mesh with_pinholes(vascular::Mesh m, int n) {
  int i = 0;
  std::erase_if(m.triangles, [&](const std::array<int, 3>&) { return ++i % n == 0; });
  return m;
}

/// Flips triangles within `reach_m` of `p`.
inline vascular::Mesh with_flipped_patch(vascular::Mesh m, const Eigen::Vector3d& p, double reach_m) {
  for (auto& t : m.triangles)
    if ((middle_of(m, t) - p).norm() < reach_m) std::swap(t[1], t[2]);
  return m;
}

/// Adds a second shell around it.
inline vascular::Mesh with_outer_wall(vascular::Mesh m, double thickness_m) {
  std::vector<Eigen::Vector3d> normal(m.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : m.triangles)
    for (int v : {a, b, c}) normal[v] += (m.vertices[b] - m.vertices[a]).cross(m.vertices[c] - m.vertices[a]);
  vascular::Mesh outer = m;
  for (std::size_t v = 0; v < normal.size(); ++v) outer.vertices[v] += thickness_m * normal[v].normalized();
  append(m, outer);
  return m;
}

/// Widens the part beyond a plane across `along` at `p` by `step_m`, and cuts it off there: two pieces end to end.
inline vascular::Mesh with_step(vascular::Mesh m, const Eigen::Vector3d& p, const Eigen::Vector3d& along,
                                double step_m) {
  vascular::Mesh beyond = with_outer_wall(m, step_m);
  const auto half = static_cast<long>(beyond.triangles.size() / 2);
  beyond.triangles.erase(beyond.triangles.begin(), beyond.triangles.begin() + half);
  const auto ahead = [&](const vascular::Mesh& mesh, const std::array<int, 3>& t) {
    return (middle_of(mesh, t) - p).dot(along);
  };
  std::erase_if(beyond.triangles, [&](const std::array<int, 3>& t) { return ahead(beyond, t) < 0; });
  std::erase_if(m.triangles, [&](const std::array<int, 3>& t) { return ahead(m, t) > 0; });
  append(m, beyond);
  return m;
}

/// Moves vertices randomly; `deviation_m`: standard deviation over all directions together.
inline vascular::Mesh with_noise(vascular::Mesh m, double deviation_m, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> move(0, deviation_m / std::sqrt(3.0));
  for (Eigen::Vector3d& p : m.vertices) p += Eigen::Vector3d(move(engine), move(engine), move(engine));
  return m;
}

inline vascular::Mesh scaled(vascular::Mesh m, double factor) {
  for (Eigen::Vector3d& p : m.vertices) p *= factor;
  return m;
}

}  // namespace ostium::test
