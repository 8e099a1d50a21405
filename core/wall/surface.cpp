#include "core/wall/surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/wall/surface_boxes.h"

namespace ostium::core {

SurfaceEditor::SurfaceEditor(const SurfaceDescription& description, Surface& surface)
    : surface_(surface),
      first_corner_(description.frames[0].size() + 1, 0),
      corners_(surface.corners),
      cluster_of_(surface.corners),
      leaf_of_(surface.clusters.size()),
      parent_(surface.nodes.size(), -1),
      changed_(surface.nodes.size(), 0) {
  for (int v : surface.corner_vertex) ++first_corner_[v + 1];
  std::partial_sum(first_corner_.begin(), first_corner_.end(), first_corner_.begin());
  std::vector<int> next(first_corner_.begin(), first_corner_.end() - 1);
  for (int c = 0; c < surface.corners; ++c) corners_[next[surface.corner_vertex[c]]++] = c;
  for (int k = 0; k < static_cast<int>(surface.clusters.size()); ++k)
    for (int c = 0; c < surface.clusters[k].corners; ++c) cluster_of_[surface.clusters[k].first_corner + c] = k;
  for (int n = 0; n < static_cast<int>(surface.nodes.size()); ++n) {
    const Surface::Node& node = surface.nodes[n];
    if (node.cluster >= 0)
      leaf_of_[node.cluster] = n;
    else
      parent_[n + 1] = parent_[surface.nodes[n + 1].skip] = n;
  }
  pending_.reserve(surface.nodes.size());
}

namespace {

/// Sets a number; returns the square of its change.
double set(float& number, double to) {
  const double was = number;
  number = static_cast<float>(to);
  return (double{number} - was) * (double{number} - was);
}

}  // namespace

void SurfaceEditor::place(int vertex, int frame, const Eigen::Vector3d& p_W) {
  constexpr double weights = 1.25;  // between frames: sum of |w| of frame_weights, at most
  for (int k = first_corner_[vertex]; k < first_corner_[vertex + 1]; ++k) {
    const int corner = corners_[k];
    const Surface::Cluster& c = surface_.clusters[cluster_of_[corner]];
    double moved2 = 0;
    for (int axis = 0; axis < 3; ++axis)
      moved2 += set(surface_.corner_frames[surface_.row(c, frame, axis) + corner - c.first_corner], p_W[axis]);
    moved_m_ = std::max(moved_m_, weights * std::sqrt(moved2));
    mark(corner);
  }
}

void SurfaceEditor::mark(int corner) {
  for (int n = leaf_of_[cluster_of_[corner]]; n >= 0 && !changed_[n]; n = parent_[n])
    changed_[n] = 1, pending_.push_back(n);
}

void SurfaceEditor::refit() {
  std::sort(pending_.begin(), pending_.end(), std::greater<>());  // children come after their parents
  const int nodes = static_cast<int>(surface_.nodes.size());
  for (int k = 0; k < surface_.frames; ++k) {
    Box* boxes = &surface_.boxes[std::size_t{1} * k * nodes];
    for (int n : pending_) boxes[n] = box_of(surface_, boxes, n, k);
  }
  for (int n : pending_) {
    if (surface_.nodes[n].cluster < 0) continue;
    Surface::Cluster& c = surface_.clusters[surface_.nodes[n].cluster];
    c.stands_still = stands_still(surface_, c);
    bound_frames(surface_.nodes[n].cluster, surface_);
  }
  if (!pending_.empty()) ++surface_.edits;
  settle();
}

void SurfaceEditor::settle() {
  for (int n : pending_) {
    changed_[n] = 0;
    if (const int cluster = surface_.nodes[n].cluster; cluster >= 0) ++surface_.clusters[cluster].version;
  }
  pending_.clear();
  surface_.moved_m += moved_m_;
  moved_m_ = 0;
}

void SurfaceEditor::let_yield() {
  surface_.corner_aside.assign(std::size_t{3} * surface_.corners, 0);
  surface_.aside_boxes.assign(surface_.nodes.size(), Box{});
}

void SurfaceEditor::put_aside(int vertex, const Eigen::Vector3d& by_W) {
  for (int k = first_corner_[vertex]; k < first_corner_[vertex + 1]; ++k) {
    const int corner = corners_[k];
    const Surface::Cluster& c = surface_.clusters[cluster_of_[corner]];
    double moved2 = 0;
    for (int axis = 0; axis < 3; ++axis)
      moved2 += set(surface_.corner_aside[surface_.sway_row(c, axis) + corner - c.first_corner], by_W[axis]);
    moved_m_ = std::max(moved_m_, std::sqrt(moved2));
    mark(corner);
  }
}

void SurfaceEditor::refit_aside() {
  std::sort(pending_.begin(), pending_.end(), std::greater<>());
  for (int n : pending_) {
    const int cluster = surface_.nodes[n].cluster;
    surface_.aside_boxes[n] = cluster >= 0 ? box_of_corners(surface_, surface_.corner_aside, surface_.clusters[cluster])
                                           : around_children(surface_, surface_.aside_boxes.data(), n);
  }
  settle();
}

std::array<double, 4> frame_weights(double x) {
  const double x2 = x * x, x3 = x2 * x;
  return {(-x3 + 2 * x2 - x) / 2, (3 * x3 - 5 * x2 + 2) / 2, (-3 * x3 + 4 * x2 + x) / 2, (x3 - x2) / 2};
}

SurfaceMotion part_of(const SurfaceMotion& whole, int frames, double from, double to) {
  if (from == 0 && to == 1) return whole;
  double move = whole.frame_after - whole.frame_before;
  move -= frames * std::round(move / frames);
  const Eigen::Vector3d shift_W = whole.shift_after_W - whole.shift_before_W;
  const double sway = whole.sway_after - whole.sway_before;
  SurfaceMotion part = whole;
  part.frame_before = whole.frame_before + from * move, part.frame_after = whole.frame_before + to * move;
  part.shift_before_W = whole.shift_before_W + from * shift_W, part.shift_after_W = whole.shift_before_W + to * shift_W;
  part.sway_before = whole.sway_before + from * sway, part.sway_after = whole.sway_before + to * sway;
  return part;
}

Eigen::Vector3d vertex_at(const SurfaceDescription& d, int vertex, double frame, double sway) {
  if (sway != 0 && !d.sway.empty()) return vertex_at(d, vertex, frame) + sway * d.sway[vertex];
  const int frames = static_cast<int>(d.frames.size());
  if (frames == 1) return d.frames[0][vertex];
  const double k = std::floor(frame);
  const std::array<double, 4> w = frame_weights(frame - k);
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (int j = 0; j < 4; ++j)
    p += w[j] * d.frames[wrapped(static_cast<int>(std::fmod(k, frames)) + j - 1, frames)][vertex];
  return p;
}

double curvature_towards(const V3<double>& e, const Surface::Triangle& triangle, const V3<double>& a,
                         const V3<double>& b, const V3<double>& c) {
  const V3<double> e1 = b - a, n = cross(e1, c - a), w = cross(n, e1);
  const double eu = dot(e, e1) / std::sqrt(dot(e1, e1)), ev = dot(e, w) / std::sqrt(dot(w, w));
  const auto& s = triangle.curvature;
  return s[0] * eu * eu + 2 * s[1] * eu * ev + s[2] * ev * ev;
}

}  // namespace ostium::core
