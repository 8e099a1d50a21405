#include "core/wall/surface_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostium::core {

namespace {

/// Box of a cluster over an interval.
Box leaf_box(const Surface& surface, const Surface::Cluster& c, int interval) {
  constexpr float large = std::numeric_limits<float>::max(), rounding = 1e-6f;
  Box box{{large, large, large}, {-large, -large, -large}};
  const auto row = [&](int frame, int axis) {
    return &surface.corner_frames[surface.row(c, wrapped(frame, surface.frames), axis)];
  };
  for (int axis = 0; axis < 3; ++axis) {
    const float *before = row(interval - 1, axis), *from = row(interval, axis), *to = row(interval + 1, axis),
                *behind = row(interval + 2, axis);
    for (int i = 0; i < c.corners; ++i) {
      const float p0 = before[i], p1 = from[i], p2 = to[i], p3 = behind[i];
      for (const float b : {p1, p1 + (p2 - p0) / 6, p2 - (p3 - p1) / 6, p2})
        box.low[axis] = std::min(box.low[axis], b - rounding), box.high[axis] = std::max(box.high[axis], b + rounding);
    }
  }
  return box;
}

}  // namespace

bool stands_still(const Surface& surface, const Surface::Cluster& c) {
  for (int axis = 0; axis < 3; ++axis) {
    const float* first = &surface.corner_frames[surface.row(c, 0, axis)];
    for (int frame = 1; frame < surface.frames; ++frame)
      if (!std::equal(first, first + c.corners, &surface.corner_frames[surface.row(c, frame, axis)])) return false;
  }
  return true;
}

void bound_frames(int cluster, Surface& surface) {
  constexpr float rounding = 1e-6f;
  const Surface::Cluster& c = surface.clusters[cluster];
  const int n = surface.frames;
  FrameBounds* to = &surface.frame_bounds[std::size_t{1} * cluster * (n + 3)] + 1;
  for (int f = 0; f < n; ++f)
    for (int axis = 0; axis < 3; ++axis) {
      const float* row = &surface.corner_frames[surface.row(c, f, axis)];
      const auto [low, high] = std::minmax_element(row, row + c.corners);
      to[f].box.low[axis] = *low, to[f].box.high[axis] = *high;
    }
  for (int f = 0; f < n; ++f) {
    const int g = (f + 1) % n;
    float most2 = 0;
    for (int i = 0; i < c.corners; ++i) {
      float beside2 = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Box &here = to[f].box, &there = to[g].box;
        const float drift = (there.low[axis] + there.high[axis] - here.low[axis] - here.high[axis]) / 2;
        const float beside = surface.corner_frames[surface.row(c, g, axis) + i] -
                             surface.corner_frames[surface.row(c, f, axis) + i] - drift;
        beside2 += beside * beside;
      }
      most2 = std::max(most2, beside2);
    }
    to[f].spread_m = std::sqrt(most2) + rounding;
  }
  to[-1] = to[n - 1], to[n] = to[0], to[n + 1] = to[1 % n];
}

Box box_of_corners(const Surface& surface, const std::vector<float>& displacements, const Surface::Cluster& c) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const float* row = &displacements[surface.sway_row(c, axis)];
    const auto [low, high] = std::minmax_element(row, row + c.corners);
    box.low[axis] = *low, box.high[axis] = *high;
  }
  return box;
}

Box around_children(const Surface& surface, const Box* boxes, int n) {
  const Box &a = boxes[n + 1], &b = boxes[surface.nodes[n + 1].skip];
  Box box;
  for (int axis = 0; axis < 3; ++axis)
    box.low[axis] = std::min(a.low[axis], b.low[axis]), box.high[axis] = std::max(a.high[axis], b.high[axis]);
  return box;
}

Box box_of(const Surface& surface, const Box* boxes, int n, int interval) {
  const Surface::Node& node = surface.nodes[n];
  if (node.cluster >= 0) return leaf_box(surface, surface.clusters[node.cluster], interval);
  return around_children(surface, boxes, n);
}

}  // namespace ostium::core
