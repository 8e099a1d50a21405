#include "vascular/geometry/mesh/winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/units.h"
#include "core/math/solid_angle.h"

namespace ostium::vascular {

namespace {
constexpr int triangles_a_leaf = 8;
constexpr double far_enough = 2;  // in reaches: error about 1 %
constexpr std::size_t most_sampled = 400'000;
}  // namespace

WindingNumber::WindingNumber(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  for (const auto& [a, b, c] : mesh.triangles)
    middles_.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

int WindingNumber::build(int first, int last) {
  const int self = static_cast<int>(nodes_.size());
  Node node{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0, first, last, -1};
  Eigen::AlignedBox3d box;
  double areas = 0;
  for (int i = first; i < last; ++i) {
    const auto& [a, b, c] = mesh_.triangles[order_[i]];
    const Eigen::Vector3d area =
        (mesh_.vertices[b] - mesh_.vertices[a]).cross(mesh_.vertices[c] - mesh_.vertices[a]) / 2;
    node.dipole += area;
    node.middle += area.norm() * middles_[order_[i]];
    areas += area.norm();
    box.extend(middles_[order_[i]]);
  }
  node.middle = areas > 0 ? Eigen::Vector3d(node.middle / areas) : box.center();
  for (int i = first; i < last; ++i)
    for (int v : mesh_.triangles[order_[i]])
      node.reach = std::max(node.reach, (mesh_.vertices[v] - node.middle).norm());
  nodes_.push_back(node);
  if (last - first <= triangles_a_leaf) return self;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last, [&](int i, int j) {
    return middles_[i][axis] < middles_[j][axis] || (middles_[i][axis] == middles_[j][axis] && i < j);
  });
  build(first, half);
  const int right = build(half, last);
  nodes_[self].right = right;
  return self;
}

double WindingNumber::triangle_at(int t, const Eigen::Vector3d& p) const {
  const auto& [a, b, c] = mesh_.triangles[static_cast<std::size_t>(t)];
  return core::solid_angle(mesh_.vertices[static_cast<std::size_t>(a)] - p,
                           mesh_.vertices[static_cast<std::size_t>(b)] - p,
                           mesh_.vertices[static_cast<std::size_t>(c)] - p) /
         (4 * units::pi);
}

double WindingNumber::at(const Eigen::Vector3d& p) const {
  double sum = 0;
  int todo[128], open = 0;
  if (!nodes_.empty()) todo[open++] = 0;
  while (open > 0) {
    const int n = todo[--open];
    const Node& node = nodes_[n];
    const Eigen::Vector3d to = node.middle - p;
    const double distance = to.norm();
    if (distance > far_enough * node.reach) {
      sum += node.dipole.dot(to) / (4 * units::pi * distance * distance * distance);
    } else if (node.right < 0) {
      for (int i = node.first; i < node.last; ++i) sum += triangle_at(order_[i], p);
    } else {
      todo[open++] = n + 1;
      todo[open++] = node.right;
    }
  }
  return sum;
}

std::vector<std::array<int, 3>> bordering_triangles(const Mesh& mesh, const WindingNumber& winding, double step_m) {
  if (mesh.triangles.size() > most_sampled) return mesh.triangles;
  std::vector<std::array<int, 3>> kept;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Eigen::Vector3d area = (b - a).cross(c - a);
    if (area.isZero(0)) continue;
    const Eigen::Vector3d out = step_m * area.normalized();
    bool borders = false;
    for (const Eigen::Vector3d& w :
         {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(8, 1, 1), Eigen::Vector3d(1, 8, 1), Eigen::Vector3d(1, 1, 8)}) {
      const Eigen::Vector3d p = (w[0] * a + w[1] * b + w[2] * c) / w.sum();
      borders = winding.inside(p - out) != winding.inside(p + out);
      if (borders) break;
    }
    if (borders) kept.push_back(t);
  }
  return kept;
}

}  // namespace ostium::vascular
