#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/wall/surface_boxes.h"

namespace ostium::core {

namespace {

using Eigen::Vector3d;

void check(const SurfaceDescription& d) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("surface: " + what); };
  if (d.frames.empty() || d.frames[0].empty() || d.triangles.empty()) refuse("it has no triangles");
  if (!(d.stiffness_N_m2 >= 0 && std::isfinite(d.stiffness_N_m2))) refuse("its stiffness must not be negative");
  if (!(d.friction >= 0 && d.friction <= 2)) refuse("its friction must be within 0 to 2");
  const int vertices = static_cast<int>(d.frames[0].size());
  for (std::size_t f = 0; f < d.frames.size(); ++f) {
    if (d.frames[f].size() != d.frames[0].size())
      refuse("frame " + std::to_string(f) + " has " + std::to_string(d.frames[f].size()) + " vertices, frame 0 has " +
             std::to_string(vertices));
    for (int v = 0; v < vertices; ++v)
      if (!d.frames[f][v].allFinite())
        refuse("vertex " + std::to_string(v) + " of frame " + std::to_string(f) + " is not finite");
  }
  if (!d.sway.empty() && d.sway.size() != d.frames[0].size())
    refuse("its sway has " + std::to_string(d.sway.size()) + " vertices, frame 0 has " + std::to_string(vertices));
  for (std::size_t v = 0; v < d.sway.size(); ++v)
    if (!d.sway[v].allFinite()) refuse("the sway of vertex " + std::to_string(v) + " is not finite");
  for (std::size_t t = 0; t < d.triangles.size(); ++t)
    for (int v : d.triangles[t])
      if (v < 0 || v >= vertices) refuse("triangle " + std::to_string(t) + " names vertex " + std::to_string(v));
  for (int t : d.door)
    if (t < 0 || t >= static_cast<int>(d.triangles.size())) refuse("its door names triangle " + std::to_string(t));
  if (!(d.door_passes_m >= 0 && std::isfinite(d.door_passes_m))) refuse("what its door passes must not be negative");
}

std::vector<char> is_door(const SurfaceDescription& d) {
  std::vector<char> door(d.triangles.size(), 0);
  for (int t : d.door) door[static_cast<std::size_t>(t)] = 1;
  return door;
}

/// Vertex normals of the first frame, outwards, weighted by the triangles' angles. Where a door meets the wall they are
/// the wall's.
std::vector<Vector3d> vertex_normals(const SurfaceDescription& d) {
  const auto& p = d.frames[0];
  const std::vector<char> door = is_door(d);
  std::vector<char> of_wall(p.size(), 0);
  for (std::size_t k = 0; k < d.triangles.size(); ++k)
    if (!door[k])
      for (int v : d.triangles[k]) of_wall[v] = 1;
  std::vector<Vector3d> normals(p.size(), Vector3d::Zero());
  for (std::size_t j = 0; j < d.triangles.size(); ++j) {
    const auto& t = d.triangles[j];
    const Vector3d n = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
    for (int k = 0; k < 3; ++k) {
      if (door[j] && of_wall[t[k]]) continue;
      const Vector3d e = p[t[(k + 1) % 3]] - p[t[k]], f = p[t[(k + 2) % 3]] - p[t[k]];
      normals[t[k]] += std::atan2(e.cross(f).norm(), e.dot(f)) * n;
    }
  }
  for (Vector3d& n : normals) n.normalize();
  return normals;
}

/// The shape operator of a triangle from its vertex normals, in the basis u along its first edge, v perpendicular to
/// it.
std::array<float, 3> shape_operator(const SurfaceDescription& d, const std::vector<Vector3d>& normals,
                                    const std::array<int, 3>& t) {
  const auto& p = d.frames[0];
  const Vector3d e1 = p[t[1]] - p[t[0]], e2 = p[t[2]] - p[t[0]], n = e1.cross(e2);
  if (!(n.norm() > 1e-14)) return {0, 0, 0};
  const Vector3d u = e1.normalized(), v = n.normalized().cross(u);
  Eigen::Matrix2d edges, turns;
  edges << e1.dot(u), e2.dot(u), e1.dot(v), e2.dot(v);
  const Vector3d n1 = normals[t[1]] - normals[t[0]], n2 = normals[t[2]] - normals[t[0]];
  turns << n1.dot(u), n2.dot(u), n1.dot(v), n2.dot(v);
  const Eigen::Matrix2d S = turns * edges.inverse();  // outward normals diverge where the lumen is hollow
  return {static_cast<float>(S(0, 0)), static_cast<float>((S(0, 1) + S(1, 0)) / 2), static_cast<float>(S(1, 1))};
}

class Builder {
 public:
  explicit Builder(const SurfaceDescription& d)
      : d_(d), normals_(vertex_normals(d)), door_(is_door(d)), order_(d.triangles.size()) {
    out_.door_passes_m = d.door_passes_m;
    out_.frames = static_cast<int>(d.frames.size());
    out_.stiffness_N_m2 = d.stiffness_N_m2, out_.friction = d.friction;
    std::iota(order_.begin(), order_.end(), 0);
    centres_.resize(d.triangles.size(), Vector3d::Zero());
    for (const auto& frame : d.frames)
      for (std::size_t t = 0; t < d.triangles.size(); ++t)
        for (int v : d.triangles[t]) centres_[t] += frame[v];
    split(0, static_cast<int>(order_.size()));
    lay_out_corners();
    make_boxes();
  }
  Surface take() { return std::move(out_); }

 private:
  /// Builds the tree over order_[begin, end).
  void split(int begin, int end) {
    const std::size_t node = out_.nodes.size();
    out_.nodes.emplace_back();
    if (end - begin <= cluster_size) {
      out_.nodes[node].cluster = static_cast<int>(out_.clusters.size());
      add_cluster(begin, end);
    } else {
      Vector3d low = Vector3d::Constant(1e300), high = -low;
      for (int k = begin; k < end; ++k)
        low = low.cwiseMin(centres_[order_[k]]), high = high.cwiseMax(centres_[order_[k]]);
      int axis = 0;
      (high - low).maxCoeff(&axis);
      const int middle = begin + (end - begin) / 2;
      std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                       [&](int a, int b) { return std::pair(centres_[a][axis], a) < std::pair(centres_[b][axis], b); });
      split(begin, middle);
      split(middle, end);
    }
    out_.nodes[node].skip = static_cast<int>(out_.nodes.size());
  }

  void add_cluster(int begin, int end) {
    std::sort(order_.begin() + begin, order_.begin() + end);
    Surface::Cluster c;
    c.first_triangle = static_cast<int>(out_.triangles.size()), c.triangles = end - begin;
    c.first_corner = static_cast<int>(out_.corner_vertex.size());
    std::map<int, int> corner;
    for (int k = begin; k < end; ++k) {
      Surface::Triangle triangle;
      triangle.id = order_[k], triangle.door = door_[order_[k]];
      triangle.curvature = shape_operator(d_, normals_, d_.triangles[order_[k]]);
      for (int j = 0; j < 3; ++j) {
        const int v = d_.triangles[order_[k]][j];
        const auto [it, fresh] = corner.try_emplace(v, static_cast<int>(corner.size()));
        if (fresh) out_.corner_vertex.push_back(v);
        triangle.corner[j] = static_cast<unsigned char>(it->second);
      }
      out_.triangles.push_back(triangle);
    }
    c.corners = static_cast<int>(corner.size());
    out_.largest_cluster = std::max(out_.largest_cluster, c.corners);
    out_.clusters.push_back(c);
  }

  void lay_out_corners() {
    out_.corners = static_cast<int>(out_.corner_vertex.size());
    out_.corner_frames.resize(std::size_t{3} * out_.frames * out_.corners);
    for (const Surface::Cluster& c : out_.clusters)
      for (int frame = 0; frame < out_.frames; ++frame)
        for (int axis = 0; axis < 3; ++axis)
          for (int i = 0; i < c.corners; ++i)
            out_.corner_frames[out_.row(c, frame, axis) + i] =
                static_cast<float>(d_.frames[frame][out_.corner_vertex[c.first_corner + i]][axis]);
    if (!d_.sway.empty()) {
      out_.corner_sway.resize(std::size_t{3} * out_.corners);
      for (const Surface::Cluster& c : out_.clusters)
        for (int axis = 0; axis < 3; ++axis)
          for (int i = 0; i < c.corners; ++i)
            out_.corner_sway[out_.sway_row(c, axis) + i] =
                static_cast<float>(d_.sway[out_.corner_vertex[c.first_corner + i]][axis]);
    }
    for (Surface::Cluster& c : out_.clusters) c.stands_still = stands_still(out_, c);
    if (!(d_.stiffness_N_m2 > 0)) return;
    for (int v : out_.corner_vertex) {
      const Eigen::Vector3f n = normals_[v].cast<float>();
      out_.corner_normals.push_back({n[0], n[1], n[2]});
    }
  }

  void make_boxes() {
    const int nodes = static_cast<int>(out_.nodes.size());
    out_.boxes.resize(std::size_t{1} * out_.frames * nodes);
    for (int n = nodes - 1; n >= 0; --n)  // a cluster's corners are stored once for all intervals
      for (int k = 0; k < out_.frames; ++k) {
        Box* boxes = &out_.boxes[std::size_t{1} * k * nodes];
        boxes[n] = box_of(out_, boxes, n, k);
      }
    out_.frame_bounds.resize(out_.clusters.size() * std::size_t{1} * (out_.frames + 3));
    for (int c = 0; c < static_cast<int>(out_.clusters.size()); ++c) bound_frames(c, out_);
    if (!out_.sways()) return;
    out_.sway_boxes.resize(nodes);
    for (int n = nodes - 1; n >= 0; --n) {
      const int cluster = out_.nodes[n].cluster;
      out_.sway_boxes[n] = cluster >= 0 ? box_of_corners(out_, out_.corner_sway, out_.clusters[cluster])
                                        : around_children(out_, out_.sway_boxes.data(), n);
    }
  }

  const SurfaceDescription& d_;
  std::vector<Vector3d> normals_;
  std::vector<char> door_;
  std::vector<int> order_;
  std::vector<Vector3d> centres_;
  Surface out_;
};

}  // namespace

Surface make_surface(const SurfaceDescription& description) {
  check(description);
  return Builder(description).take();
}

}  // namespace ostium::core
