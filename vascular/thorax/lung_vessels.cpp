#include "vascular/thorax/lung_vessels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "vascular/geometry/implicit/draws.h"
#include "vascular/thorax/shapes.h"

namespace ostium::vascular {

namespace {

using Eigen::Vector3d;
using units::mm;

constexpr double exponent = 3;
constexpr double piece_m = 9 * mm;  // straight for so long

struct Node {
  Vector3d p;
  int parent = -1;
  double flow = 0;  // radius to the power of the exponent
};

/// Evenly: by Halton's sequence in a box, those that lie in the lung.
std::vector<Vector3d> ends_in(const std::function<double(const Vector3d&)>& lung, double side, int count, int skip) {
  const auto halton = [](int i, int base) {
    double f = 1, r = 0;
    for (; i > 0; i /= base) r += (f /= base) * (i % base);
    return r;
  };
  std::vector<Vector3d> out;
  for (int i = skip + 1; i < skip + 40 * count && static_cast<int>(out.size()) < count; ++i) {
    const Vector3d p(side * (10 + 145 * halton(i, 2)) * mm, (-190 + 310 * halton(i, 3)) * mm,
                     (-120 + 225 * halton(i, 5)) * mm);
    if (lung(p) < -2 * mm) out.push_back(p);
  }
  return out;
}

void grow(const Vector3d& hilum, std::vector<Vector3d> ends, const LungVesselOptions& o, Draws& draw,
          std::vector<LungVessel>& out) {
  std::sort(ends.begin(), ends.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - hilum).squaredNorm() < (b - hilum).squaredNorm();
  });
  std::vector<Node> nodes{{hilum, -1, 0}};
  for (const Vector3d& end : ends) {
    int at = 0;
    // What lies nearer to the hilum than the end, so that branches run outwards.
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i)
      if ((nodes[i].p - end).squaredNorm() < (nodes[at].p - end).squaredNorm()) at = i;
    const Vector3d from = nodes[at].p, way = end - from;
    const int pieces = std::max(1, static_cast<int>(way.norm() / piece_m));
    const Vector3d bow = 0.12 * way.norm() * draw.normals();
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      nodes.push_back({from + t * way + t * (1 - t) * bow, at, 0});
      at = static_cast<int>(nodes.size()) - 1;
    }
    nodes[at].flow = std::pow(o.end_radius_m * draw.between(0.6, 1.4), exponent);
  }
  for (int i = static_cast<int>(nodes.size()) - 1; i > 0; --i) nodes[nodes[i].parent].flow += nodes[i].flow;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Node& n = nodes[i];
    const double r = std::pow(n.flow, 1 / exponent);
    out.push_back({nodes[n.parent].p, n.p, r, r});
  }
}

}  // namespace

std::vector<LungVessel> grow_lung_vessels(const std::function<double(const Vector3d&)>& lung,
                                          const LungVesselOptions& o) {
  std::vector<LungVessel> out;
  Draws draw(o.seed);
  int skip = static_cast<int>(draw.between(0, 5000));
  for (double side : {-1.0, 1.0}) {
    const Vector3d arteries(side * 42 * mm, 6 * mm, -30 * mm), veins(side * 36 * mm, -16 * mm, -16 * mm);
    for (const Vector3d& hilum : {arteries, veins}) {
      grow(hilum, ends_in(lung, side, o.ends, skip), o, draw, out);
      skip += 7919;
    }
  }
  return out;
}

Mesh mesh_of(const std::vector<LungVessel>& vessels) {
  const auto key = [](const Vector3d& p) { return std::array{p.x(), p.y(), p.z()}; };
  const auto thicker = [&](int a, int b) { return vessels[a].radius_a_m < vessels[b].radius_a_m; };
  // Of the pieces that begin where one ends, the thickest goes on from it.
  std::map<std::array<double, 3>, std::vector<int>> begin_at;
  std::map<std::array<double, 3>, double> radius_at;
  for (int i = 0; i < static_cast<int>(vessels.size()); ++i) {
    begin_at[key(vessels[i].a)].push_back(i);
    double& radius = radius_at[key(vessels[i].b)];
    radius = std::max(radius, vessels[i].radius_b_m);
  }
  for (auto& [p, pieces] : begin_at)
    std::swap(pieces.front(), *std::max_element(pieces.begin(), pieces.end(), thicker));
  Mesh out;
  for (const auto& [p, pieces] : begin_at)
    for (int first : pieces) {
      const auto stem = radius_at.find(p);
      if (stem != radius_at.end() && first == pieces.front()) continue;  // it goes on from the one before
      const LungVessel& head = vessels[first];
      // From within the wall of the one it leaves, so that what both hold is not counted twice.
      const double length = (head.b - head.a).norm(),
                   inside = stem == radius_at.end() ? 0 : std::min(0.9 * stem->second, 0.8 * length);
      std::vector<Vector3d> line{head.a + inside / length * (head.b - head.a), head.b};
      std::vector<double> radius{head.radius_a_m, head.radius_b_m};
      for (auto next = begin_at.find(key(head.b)); next != begin_at.end();) {
        const LungVessel& piece = vessels[next->second.front()];
        radius.back() = 0.5 * (radius.back() + piece.radius_a_m);
        line.push_back(piece.b);
        radius.push_back(piece.radius_b_m);
        next = begin_at.find(key(piece.b));
      }
      append(out, rod(line, radius, head.radius_a_m > 1.5 * mm ? 8 : 5));
    }
  return out;
}

}  // namespace ostium::vascular
