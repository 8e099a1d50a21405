#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

#include <algorithm>
#include <numeric>

namespace ostium::vascular {

namespace {
constexpr int leaf_size = 4;
}

BoundingVolumeHierarchy::BoundingVolumeHierarchy(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::Vector3d> middles;
  middles.reserve(order_.size());
  for (const auto& [a, b, c] : mesh.triangles)
    middles.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
  nodes_.reserve(order_.size());
  if (!order_.empty()) build(0, static_cast<int>(order_.size()), middles);
}

Eigen::AlignedBox3d BoundingVolumeHierarchy::box_of(int triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  Eigen::AlignedBox3d box(mesh_.vertices[a]);
  return box.extend(mesh_.vertices[b]).extend(mesh_.vertices[c]);
}

void BoundingVolumeHierarchy::build(int first, int last, const std::vector<Eigen::Vector3d>& middles) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({.box = {}, .first = first, .last = last});
  Eigen::AlignedBox3d box, of_middles;
  for (int i = first; i < last; ++i) {
    box.extend(box_of(order_[i]));
    of_middles.extend(middles[order_[i]]);
  }
  nodes_[self].box = box;
  if (last - first <= leaf_size) return;
  int axis = 0;
  of_middles.sizes().maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last, [&](int i, int j) {
    return middles[i][axis] < middles[j][axis] || (middles[i][axis] == middles[j][axis] && i < j);
  });
  build(first, half, middles);
  nodes_[self].right = static_cast<int>(nodes_.size());
  build(half, last, middles);
}

void BoundingVolumeHierarchy::for_each_pair(const std::function<void(int, int)>& visit) const {
  if (!nodes_.empty()) pairs(0, 0, visit);
}

void BoundingVolumeHierarchy::pairs(int a, int b, const std::function<void(int, int)>& visit) const {
  const Node &A = nodes_[a], &B = nodes_[b];
  if (a != b && !A.box.intersects(B.box)) return;
  const bool leaf_a = A.right < 0, leaf_b = B.right < 0;
  if (leaf_a && leaf_b) {
    for (int i = A.first; i < A.last; ++i)
      for (int j = a == b ? i + 1 : B.first; j < B.last; ++j)
        if (box_of(order_[i]).intersects(box_of(order_[j])))
          visit(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
  } else if (a == b) {
    pairs(a + 1, a + 1, visit);
    pairs(a + 1, A.right, visit);
    pairs(A.right, A.right, visit);
  } else if (leaf_b || (!leaf_a && A.last - A.first > B.last - B.first)) {
    pairs(a + 1, b, visit);
    pairs(A.right, b, visit);
  } else {
    pairs(a, b + 1, visit);
    pairs(a, B.right, visit);
  }
}

BoundingVolumeHierarchy::Nearest BoundingVolumeHierarchy::nearest(const Eigen::Vector3d& p, double limit_m) const {
  Nearest best{.distance_m = limit_m};
  std::vector<std::pair<double, int>> todo;
  if (!nodes_.empty()) todo.push_back({nodes_[0].box.exteriorDistance(p), 0});
  while (!todo.empty()) {
    const auto [distance, n] = todo.back();
    todo.pop_back();
    if (distance >= best.distance_m) continue;
    const Node& node = nodes_[n];
    if (node.right < 0) {
      for (int i = node.first; i < node.last; ++i) {
        const auto& [a, b, c] = mesh_.triangles[order_[i]];
        const Eigen::Vector3d q = nearest_on_triangle(p, mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
        if ((q - p).norm() < best.distance_m) best = {(q - p).norm(), order_[i], q};
      }
      continue;
    }
    std::pair<double, int> near{nodes_[n + 1].box.exteriorDistance(p), n + 1},
        far{nodes_[node.right].box.exteriorDistance(p), node.right};
    if (far.first < near.first) std::swap(near, far);
    todo.push_back(far);
    todo.push_back(near);
  }
  return best;
}

std::vector<BoundingVolumeHierarchy::Hit> BoundingVolumeHierarchy::hits(const Eigen::Vector3d& p,
                                                                        const Eigen::Vector3d& along,
                                                                        double limit_m) const {
  std::vector<Hit> found;
  const auto missed = [&](const Eigen::AlignedBox3d& box) {
    double from = 0, to = limit_m;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1 / along[axis];
      double a = (box.min()[axis] - p[axis]) * inverse, b = (box.max()[axis] - p[axis]) * inverse;
      if (a > b) std::swap(a, b);
      if (a > from) from = a;  // not-a-number where the ray lies in a box face: no limit
      if (b < to) to = b;
    }
    return from > to;
  };
  std::vector<int> todo;
  if (!nodes_.empty()) todo.push_back(0);
  while (!todo.empty()) {
    const int n = todo.back();
    todo.pop_back();
    const Node& node = nodes_[n];
    if (missed(node.box)) continue;
    if (node.right >= 0) {
      todo.push_back(n + 1);
      todo.push_back(node.right);
      continue;
    }
    for (int i = node.first; i < node.last; ++i) {
      // Moeller and Trumbore, J Graph Tools 1997;2:21.
      const auto& [a, b, c] = mesh_.triangles[order_[i]];
      const Eigen::Vector3d ab = mesh_.vertices[b] - mesh_.vertices[a], ac = mesh_.vertices[c] - mesh_.vertices[a];
      const Eigen::Vector3d q = along.cross(ac);
      const double determinant = ab.dot(q);
      if (determinant == 0) continue;
      const Eigen::Vector3d ap = p - mesh_.vertices[a], r = ap.cross(ab);
      const double u = ap.dot(q) / determinant, v = along.dot(r) / determinant, t = ac.dot(r) / determinant;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < limit_m) found.push_back({t, order_[i]});
    }
  }
  std::sort(found.begin(), found.end(), [](const Hit& a, const Hit& b) {
    return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.triangle < b.triangle);
  });
  return found;
}

Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a), d3 = ab.dot(p - b), d4 = ac.dot(p - b), d5 = ab.dot(p - c),
               d6 = ac.dot(p - c);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  if (!(sum > 0)) return a;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace ostium::vascular
