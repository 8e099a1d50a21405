#include "vascular/thorax/lung_vessels.h"

#include <algorithm>
#include <cmath>

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
  Mesh out;
  for (const LungVessel& v : vessels)
    append(out, rod(v.a, v.b, v.radius_a_m, v.radius_b_m, v.radius_a_m > 1.5 * mm ? 10 : 5));
  return out;
}

}  // namespace ostium::vascular
