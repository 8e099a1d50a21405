#include "vascular/geometry/implicit/contour_octree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ostium::vascular {

namespace {

constexpr double lipschitz = 1.15;   // of the union's function, including smooth minimum and tapering tubes
constexpr int units_per_finest = 8;  // cells may be halved three more times where the contour needs it

/// Child k of a cube: bits are x, y, z.
std::array<int, 3> offset(int k) { return {k & 1, k >> 1 & 1, k >> 2 & 1}; }

}  // namespace

ContourOctree::ContourOctree(const TubeUnion& lumen, const ContourSettings& settings, double shift)
    : lumen_(lumen), settings_(settings), unit_m_(settings.finest_m / units_per_finest) {
  Eigen::AlignedBox3d box;
  for (const Tube& tube : lumen.tubes())
    for (const TubeNode& node : tube.nodes) {
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(1.5 * node.radius_m + 4 * settings.finest_m);
      box.extend(node.p - reach).extend(node.p + reach);
    }
  origin_ = box.min().array() - shift * settings.finest_m;
  int size = 1;
  while (size * unit_m_ < box.sizes().maxCoeff()) size *= 2;
  std::vector<int> all(lumen.segments().size());
  std::iota(all.begin(), all.end(), 0);
  cells_.push_back({{0, 0, 0}, size});
  grow(0, all);
}

std::vector<Quad> ContourOctree::extract(std::vector<Eigen::Vector3d>& places, std::vector<Eigen::Vector3d>& outwards,
                                         std::vector<const std::vector<int>*>& near) {
  for (Vertex& v : vertices_) v.index = -1;
  quads_.clear();
  used_.clear();
  cell_edges(0);
  places.clear();
  outwards.clear();
  near.clear();
  for (Quad& quad : quads_)
    for (int& v : quad) {
      Vertex& vertex = vertices_[v];
      if (vertex.index < 0) {
        vertex.index = static_cast<int>(used_.size());
        used_.push_back(v);
        if (!vertex.placed)
          vertex.sum = onto_surface(lumen_, vertex.segments, vertex.sum / vertex.count, 2, vertex.outwards);
        vertex.placed = true;
        places.push_back(vertex.sum);
        outwards.push_back(vertex.outwards);
        near.push_back(&vertex.segments);
      }
      v = vertex.index;
    }
  return quads_;
}

bool ContourOctree::refine(const std::vector<int>& vertices) {
  bool halved = false;
  for (int i : vertices) {
    const int v = used_[i], c = vertices_[v].cell;
    if (cells_[c].vertex < 0 || cells_[c].size == 1) continue;
    cells_[c].vertex = -1;
    divide(c, std::vector<int>(vertices_[v].segments));
    halved = true;
  }
  return halved;
}

std::array<int, 3> ContourOctree::corner(const Cell& cell, int k) {
  const auto o = offset(k);
  return {cell.corner[0] + o[0] * cell.size, cell.corner[1] + o[1] * cell.size, cell.corner[2] + o[2] * cell.size};
}

Eigen::Vector3d ContourOctree::position(const std::array<int, 3>& at) const {
  return origin_ + unit_m_ * Eigen::Vector3d(at[0], at[1], at[2]);
}

double ContourOctree::wanted_size(double radius_m) const {
  return settings_.cell_at_1_mm_m * std::pow(radius_m / 1e-3, 0.75);
}

void ContourOctree::grow(int c, const std::vector<int>& candidates) {
  const double edge = cells_[c].size * unit_m_, reach = edge * std::sqrt(3.0) / 2;
  const Eigen::Vector3d middle = position(cells_[c].corner) + Eigen::Vector3d::Constant(edge / 2);
  std::vector<double> d(candidates.size()), radius(candidates.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    d[i] = lumen_.distance(candidates[i], middle, nullptr, &radius[i]);
    least = std::min(least, d[i]);
  }
  double margin = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    margin = std::max(margin, lumen_.tubes()[lumen_.segments()[candidates[i]].tube].blend * radius[i]);
  if (least > lipschitz * reach + margin / 6) return;
  // A tube matters if it may be blended with the nearest one; a segment if it may be its tube's nearest.
  std::vector<int> near;
  double wanted = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0, last = 0; first < candidates.size(); first = last) {
    const int tube = lumen_.segments()[candidates[first]].tube;
    double of_tube = std::numeric_limits<double>::infinity();
    for (; last < candidates.size() && lumen_.segments()[candidates[last]].tube == tube; ++last)
      of_tube = std::min(of_tube, d[last]);
    if (of_tube > least + 2 * lipschitz * reach + margin) continue;
    for (std::size_t i = first; i < last; ++i) {
      if (d[i] > of_tube + 2 * lipschitz * reach) continue;
      near.push_back(candidates[i]);
      if (std::fabs(d[i]) < reach + radius[i] / 2) wanted = std::min(wanted, wanted_size(radius[i]));
    }
  }
  if (std::fabs(lumen_.value(middle, near)) > lipschitz * reach) return;
  if (edge <= settings_.finest_m || edge <= wanted) {
    cells_[c].vertex = static_cast<int>(vertices_.size());
    Vertex vertex{.cell = c, .segments = std::move(near)};
    for (int k = 0; k < 8; ++k) vertex.corners[k] = value_at(corner(cells_[c], k), vertex.segments);
    vertices_.push_back(std::move(vertex));
  } else {
    divide(c, near);
  }
}

void ContourOctree::divide(int c, const std::vector<int>& candidates) {
  const std::array<int, 3> corner = cells_[c].corner;
  const int half = cells_[c].size / 2, first = static_cast<int>(cells_.size());
  cells_[c].children = first;
  for (int k = 0; k < 8; ++k) {
    const auto o = offset(k);
    cells_.push_back({{corner[0] + o[0] * half, corner[1] + o[1] * half, corner[2] + o[2] * half}, half});
  }
  for (int k = 0; k < 8; ++k) grow(first + k, candidates);
}

double ContourOctree::value_at(const std::array<int, 3>& at, const std::vector<int>& near) {
  const long key = (static_cast<long>(at[0]) << 42) | (static_cast<long>(at[1]) << 21) | at[2];
  const auto [entry, fresh] = values_.try_emplace(key, 0.0);
  if (fresh) entry->second = lumen_.value(position(at), near);
  return entry->second;
}

void ContourOctree::cell_edges(int c) {
  if (leaf(c)) return;
  for (int k = 0; k < 8; ++k) cell_edges(child(c, k));
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 8; ++k)
      if (!(k >> axis & 1)) face_edges(child(c, k), child(c, k | 1 << axis), axis);
  for (int axis = 0; axis < 3; ++axis) {
    const int b1 = 1 << (axis + 1) % 3, b2 = 1 << (axis + 2) % 3;
    for (int along : {0, 1 << axis})
      edge({child(c, along), child(c, along | b1), child(c, along | b2), child(c, along | b1 | b2)}, axis,
           {(axis + 1) % 3, (axis + 2) % 3});
  }
}

void ContourOctree::face_edges(int a, int b, int axis) {
  if ((leaf(a) && leaf(b)) || empty(a) || empty(b)) return;
  const int bit = 1 << axis;
  const int b1 = 1 << (axis + 1) % 3, b2 = 1 << (axis + 2) % 3;
  for (int k = 0; k < 8; ++k)
    if (!(k & bit)) face_edges(child(a, k | bit), child(b, k), axis);
  // Edges in the face, along each of its two directions.
  for (int along : {0, b1})
    edge({child(a, along | bit), child(a, along | bit | b2), child(b, along), child(b, along | b2)}, (axis + 1) % 3,
         {(axis + 2) % 3, axis});
  for (int along : {0, b2})
    edge({child(a, along | bit), child(b, along), child(a, along | bit | b1), child(b, along | b1)}, (axis + 2) % 3,
         {axis, (axis + 1) % 3});
}

void ContourOctree::edge(const std::array<int, 4>& around, int axis, const std::array<int, 2>& sides) {
  if (std::any_of(around.begin(), around.end(), [&](int c) { return empty(c); })) return;
  if (std::all_of(around.begin(), around.end(), [&](int c) { return leaf(c); })) return emit(around, axis, sides);
  for (int along : {0, 1 << axis}) {
    std::array<int, 4> next;
    for (int k = 0; k < 4; ++k) {
      const int towards_edge = ((k & 1) ? 0 : 1 << sides[0]) | ((k & 2) ? 0 : 1 << sides[1]);
      next[k] = child(around[k], along | towards_edge);
    }
    edge(next, axis, sides);
  }
}

void ContourOctree::emit(const std::array<int, 4>& around, int axis, const std::array<int, 2>& sides) {
  int smallest = 0;
  for (int k = 0; k < 4; ++k) {
    if (cells_[around[k]].size < cells_[around[smallest]].size) smallest = k;
  }
  const Cell& cell = cells_[around[smallest]];
  const int from = ((smallest & 1) ? 0 : 1 << sides[0]) | ((smallest & 2) ? 0 : 1 << sides[1]), to = from | 1 << axis;
  const std::array<double, 8>& corners = vertices_[cell.vertex].corners;
  const double f0 = corners[from], f1 = corners[to];
  if ((f0 < 0) == (f1 < 0)) return;
  const Eigen::Vector3d p0 = position(corner(cell, from)), p1 = position(corner(cell, to));
  const Eigen::Vector3d p = p0 + f0 / (f0 - f1) * (p1 - p0);
  std::array<int, 4> v;
  for (int k = 0; k < 4; ++k) v[k] = cells_[around[k]].vertex;
  // Count each cell once, although it may lie on two sides of the edge.
  std::array<int, 4> once = v;
  std::sort(once.begin(), once.end());
  for (auto it = once.begin(), last = std::unique(once.begin(), once.end()); it != last; ++it) {
    if (vertices_[*it].placed) continue;
    vertices_[*it].sum += p;
    ++vertices_[*it].count;
  }
  // Counter-clockwise about +axis: 0, 1, 3, 2. f grows outwards.
  std::array<int, 4> ring = {v[0], v[1], v[3], v[2]};
  if (!(f0 < 0)) std::reverse(ring.begin(), ring.end());
  quads_.push_back(ring);
}

Eigen::Vector3d onto_surface(const TubeUnion& lumen, const std::vector<int>& near, Eigen::Vector3d p, int steps,
                             Eigen::Vector3d& outwards) {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int i = 0; i < steps; ++i) {
    const double f = lumen.value(p, near, &gradient);
    const double g2 = gradient.squaredNorm();
    if (g2 > 1e-4) p -= f / std::max(g2, 0.25) * gradient;
  }
  outwards = gradient.normalized();
  return p;
}

}  // namespace ostium::vascular
