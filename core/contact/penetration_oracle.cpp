#include "core/contact/penetration_oracle.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "core/math/solid_angle.h"

namespace ostium::core {

using Eigen::Vector3d;

namespace {

double segment_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
  return (p - a - t * d).norm();
}

}  // namespace

double triangle_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  if (n.squaredNorm() > 0) {
    const auto inside = [&](const Vector3d& u, const Vector3d& v) { return (v - u).cross(p - u).dot(n) >= 0; };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::fabs((p - a).dot(n)) / n.norm();
  }
  return std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

PenetrationOracle::PenetrationOracle(const SurfaceDescription& wall) : wall_(wall) {
  const auto triangles = static_cast<Eigen::Index>(wall.triangles.size());
  for (auto* field : {&x_, &y_, &z_, &radius_}) field->resize(triangles);
  set_frame(0);
}

void PenetrationOracle::set_frame(double frame) {
  vertices_.resize(wall_.frames[0].size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) vertices_[v] = vertex_at(wall_, static_cast<int>(v), frame);
  for (std::size_t t = 0; t < wall_.triangles.size(); ++t) {
    const auto& corner = wall_.triangles[t];
    const Vector3d middle = (vertices_[corner[0]] + vertices_[corner[1]] + vertices_[corner[2]]) / 3;
    double radius = 0;
    for (int v : corner) radius = std::max(radius, (vertices_[v] - middle).norm());
    const auto i = static_cast<Eigen::Index>(t);
    x_[i] = middle.x(), y_[i] = middle.y(), z_[i] = middle.z(), radius_[i] = radius;
  }
}

double PenetrationOracle::distance_m(const Vector3d& p, double far_m) const {
  const Eigen::ArrayXd apart =
      ((x_ - p.x()).square() + (y_ - p.y()).square() + (z_ - p.z()).square()) - (radius_ + far_m).square();
  double best = far_m;
  for (Eigen::Index i = 0; i < apart.size(); ++i) {
    if (apart[i] > 0) continue;
    const auto& t = wall_.triangles[static_cast<std::size_t>(i)];
    best = std::min(best, triangle_distance(p, vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]));
  }
  return best;
}

double PenetrationOracle::winding(const Vector3d& p) const {
  double sum = 0;
  for (const auto& t : wall_.triangles)
    sum += solid_angle(vertices_[t[0]] - p, vertices_[t[1]] - p, vertices_[t[2]] - p);
  return sum / (4 * units::pi);
}

}  // namespace ostium::core
