#include "vascular/geometry/remesh/decimate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace ostium::vascular {

namespace {

constexpr double shortest = 0.75, longest = 1.5;  // relative to the requested edge length
constexpr double least_cosine = 0.5;              // for a triangle's change of direction
constexpr double least_shape = 0.04;              // area over the sum of squared edges; equilateral: 0.14
constexpr double sliver = 0.01;                   // below this shape a triangle's normal is arbitrary
constexpr double much_too_short = 0.3;            // relative to the requested edge length
constexpr int most_rounds = 6;
constexpr int gone = -1'000'000'000;  // a vertex's count of changes, so that no edge's stamp fits any more
constexpr double to_middle = 1e-3;    // weight of the edge's midpoint, where planes do not determine the position

using Quadric = Eigen::Matrix4d;

/// An edge that may collapse.
struct ShortEdge {
  double length;  ///< relative to the requested one, [0, shortest)
  int a, b, stamp;
  bool operator<(const ShortEdge& other) const {  // for a heap: the shortest on top
    return length != other.length ? length > other.length : std::tie(a, b) > std::tie(other.a, other.b);
  }
};

/// Edges, shortest first. Millions of them in one heap miss the cache at each level, so they lie in buckets by length,
/// and a bucket becomes a heap when its turn comes.
class EdgeQueue {
 public:
  EdgeQueue() : buckets_(count) {}

  void push(const ShortEdge& edge) {
    const int i = std::min(count - 1, static_cast<int>(edge.length * (count / shortest)));
    Bucket& bucket = buckets_[i];
    bucket.edges.push_back(edge);
    if (bucket.is_heap) std::push_heap(bucket.edges.begin(), bucket.edges.end());
    first_ = std::min(first_, i);
  }

  /// False when none is left.
  bool pop(ShortEdge& edge) {
    while (first_ < count && buckets_[first_].edges.empty()) ++first_;
    if (first_ == count) return false;
    auto& [edges, is_heap] = buckets_[first_];
    if (!is_heap) std::make_heap(edges.begin(), edges.end());
    is_heap = true;
    std::pop_heap(edges.begin(), edges.end());
    edge = edges.back();
    edges.pop_back();
    return true;
  }

 private:
  struct Bucket {
    std::vector<ShortEdge> edges;
    bool is_heap = false;
  };
  static constexpr int count = 4096;
  std::vector<Bucket> buckets_;
  int first_ = count;  ///< none before it has any
};

class Decimator {
 public:
  Decimator(const Mesh& mesh, const std::vector<double>& edge_m, double chance_m)
      : chance_(chance_m),
        p_(mesh.vertices),
        triangles_(mesh.triangles),
        wanted_(edge_m),
        of_vertex_(mesh.vertices.size()),
        quadrics_(mesh.vertices.size(), Quadric::Zero()),
        changed_(mesh.vertices.size(), 0) {
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      const Eigen::Vector3d area = area_of(triangles_[t]);
      if (area.norm() > 0) {
        const Eigen::Vector3d n = area.normalized();
        const Eigen::Vector4d plane(n.x(), n.y(), n.z(), -n.dot(p_[triangles_[t][0]]));
        for (int v : triangles_[t]) quadrics_[v] += area.norm() * plane * plane.transpose();
      }
      for (int v : triangles_[t]) of_vertex_[v].push_back(t);
    }
  }

  Mesh run() {
    // Very short edges that could not collapse at first may do so once their neighbours have.
    for (int round = 0, before = -1; round < most_rounds && collapsed_ != before; ++round) {
      before = collapsed_;
      for (const auto& t : triangles_)
        for (int k = 0; k < 3; ++k)
          if (t[k] < t[(k + 1) % 3]) push(t[k], t[(k + 1) % 3], round == 0 ? shortest : much_too_short);
      for (ShortEdge edge; edges_.pop(edge);) {
        if (edge.stamp == changed_[edge.a] + changed_[edge.b]) collapse(edge.a, edge.b);
      }
    }
    return result();
  }

 private:
  Eigen::Vector3d area_of(const std::array<int, 3>& t) const {
    return (p_[t[1]] - p_[t[0]]).cross(p_[t[2]] - p_[t[0]]) / 2;
  }

  void push(int a, int b, double most = shortest) {
    const double length = (p_[a] - p_[b]).norm() / std::min(wanted_[a], wanted_[b]);
    if (length < most) edges_.push({length, a, b, changed_[a] + changed_[b]});
  }

  void neighbours(int v, std::vector<int>& result) const {
    result.clear();
    for (int t : of_vertex_[v])
      for (int other : triangles_[t])
        if (other != v) result.push_back(other);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
  }

  Eigen::Vector3d place(int a, int b) const {
    const Quadric q = quadrics_[a] + quadrics_[b];
    const Eigen::Vector3d middle = (p_[a] + p_[b]) / 2;
    const double weight = to_middle * q.topLeftCorner<3, 3>().trace() + 1e-30;
    const Eigen::Matrix3d A = q.topLeftCorner<3, 3>() + weight * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d rhs = -q.topRightCorner<3, 1>() + weight * middle;
    Eigen::Vector3d best = A.ldlt().solve(rhs);
    const double reach = (p_[a] - p_[b]).norm();
    if (!best.allFinite() || (best - middle).norm() > reach) return middle;
    return best;
  }

  double squared_sides(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) const {
    return (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  }

  /// Whether the triangles of `v` without `other` keep their direction when it moves to `p`, and do not become slivers.
  /// Existing slivers do not count (neighbouring slivers would block each other for ever), but if they grow out of that
  /// shape they must face like their surroundings, `around`.
  bool keeps_facing(int v, int other, const Eigen::Vector3d& p, const Eigen::Vector3d& around) const {
    for (int t : of_vertex_[v]) {
      const auto& tri = triangles_[t];
      if (tri[0] == other || tri[1] == other || tri[2] == other) continue;
      Eigen::Vector3d c[3];
      for (int k = 0; k < 3; ++k) c[k] = tri[k] == v ? p : p_[tri[k]];
      const Eigen::Vector3d before = area_of(tri), after = (c[1] - c[0]).cross(c[2] - c[0]) / 2;
      const double sides_before = squared_sides(p_[tri[0]], p_[tri[1]], p_[tri[2]]);
      const double sides_after = squared_sides(c[0], c[1], c[2]);
      const bool was_sliver = !(before.norm() > sliver * sides_before);
      if (was_sliver && after.norm() < sliver * sides_after) continue;
      const Eigen::Vector3d& faced = was_sliver ? around : before;
      if (faced.dot(after) < least_cosine * faced.norm() * after.norm()) return false;
      if (!was_sliver &&
          after.norm() * sides_before < std::min(least_shape * sides_before, before.norm()) * sides_after)
        return false;
    }
    return true;
  }

  bool fits(int a, int b, const Eigen::Vector3d& p) const {
    const double wanted = std::min(wanted_[a], wanted_[b]);
    for (int v : all_)
      if (v != a && v != b && (p_[v] - p).norm() > longest * std::min(wanted, wanted_[v])) return false;
    Eigen::Vector3d around = Eigen::Vector3d::Zero();
    for (int v : {a, b})
      for (int t : of_vertex_[v]) around += area_of(triangles_[t]);
    return keeps_facing(a, b, p, around) && keeps_facing(b, a, p, around);
  }

  void collapse(int a, int b) {
    neighbours(a, near_a_);
    neighbours(b, near_b_);
    both_.clear();
    all_.clear();
    std::set_intersection(near_a_.begin(), near_a_.end(), near_b_.begin(), near_b_.end(), std::back_inserter(both_));
    if (both_.size() != 2) return;  // otherwise two sheets would touch
    const Eigen::Vector3d p = place(a, b);
    const double wanted = std::min(wanted_[a], wanted_[b]);
    std::set_union(near_a_.begin(), near_a_.end(), near_b_.begin(), near_b_.end(), std::back_inserter(all_));
    if (all_.size() < 5) return;
    if ((p_[a] - p_[b]).norm() >= chance_ && !fits(a, b, p)) return;
    ++collapsed_;
    p_[a] = p;
    wanted_[a] = wanted;
    quadrics_[a] += quadrics_[b];
    for (int t : of_vertex_[b]) {
      auto& tri = triangles_[t];
      if (tri[0] == a || tri[1] == a || tri[2] == a) {
        for (int v : tri)
          if (v != b) std::erase(of_vertex_[v], t);
        tri = {-1, -1, -1};
        continue;
      }
      std::replace(tri.begin(), tri.end(), b, a);
      of_vertex_[a].push_back(t);
    }
    of_vertex_[b].clear();
    changed_[b] = gone;
    ++changed_[a];
    neighbours(a, near_a_);
    for (int v : near_a_) push(std::min(a, v), std::max(a, v));
  }

  Mesh result() const {
    Mesh mesh;
    std::vector<int> index(p_.size(), -1);
    for (const auto& t : triangles_) {
      if (t[0] < 0) continue;
      std::array<int, 3> renamed;
      for (int k = 0; k < 3; ++k) {
        int& i = index[t[k]];
        if (i < 0) {
          i = static_cast<int>(mesh.vertices.size());
          mesh.vertices.push_back(p_[t[k]]);
        }
        renamed[k] = i;
      }
      mesh.triangles.push_back(renamed);
    }
    return mesh;
  }

  double chance_;
  std::vector<Eigen::Vector3d> p_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<double> wanted_;
  std::vector<std::vector<int>> of_vertex_;
  std::vector<Quadric> quadrics_;
  std::vector<int> changed_;  ///< how often, or `gone`
  EdgeQueue edges_;
  std::vector<int> near_a_, near_b_, both_, all_;  ///< of the edge that collapses: vertices beside its ends
  int collapsed_ = 0;
};

}  // namespace

Mesh decimate(const Mesh& mesh, const std::vector<double>& edge_m, double chance_m) {
  return Decimator(mesh, edge_m, chance_m).run();
}

}  // namespace ostium::vascular
