#include "core/samples/tube.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"

namespace ostium::core {

using Eigen::Vector3d;

SurfaceDescription tube(const std::vector<TubePoint>& points, int around) {
  SurfaceDescription out;
  auto& vertices = out.frames.emplace_back();
  const int rings = static_cast<int>(points.size());
  Vector3d side = Vector3d::UnitY();
  for (int i = 0; i < rings; ++i) {
    const Vector3d t = (points[std::min(i + 1, rings - 1)].p_W - points[std::max(i - 1, 0)].p_W).normalized();
    side = (side - t * t.dot(side)).normalized();
    const Vector3d up = t.cross(side);
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * units::pi * k / around;
      vertices.push_back(points[i].p_W + points[i].radius_m * (std::cos(angle) * side + std::sin(angle) * up));
    }
  }
  const auto at = [&](int ring, int k) { return ring * around + k % around; };
  for (int i = 0; i + 1 < rings; ++i)
    for (int k = 0; k < around; ++k) {
      out.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      out.triangles.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  for (int ring : {0, rings - 1}) {
    const int middle = static_cast<int>(vertices.size());
    vertices.push_back(points[ring].p_W);
    for (int k = 0; k < around; ++k)
      if (ring == 0)
        out.triangles.push_back({middle, at(ring, k + 1), at(ring, k)});
      else
        out.triangles.push_back({middle, at(ring, k), at(ring, k + 1)});
  }
  return out;
}

std::vector<TubePoint> bend(double bend_radius_m, double angle, double lead_m, double trail_m, double radius_m,
                            double spacing_m) {
  std::vector<TubePoint> out;
  const double length = lead_m + bend_radius_m * angle + trail_m;
  const int pieces = static_cast<int>(std::ceil(length / spacing_m));
  for (int i = 0; i <= pieces; ++i) {
    const double s = length * i / pieces, phi = std::clamp((s - lead_m) / bend_radius_m, 0.0, angle);
    const double straight = std::min(s, lead_m), after = std::max(0.0, s - lead_m - bend_radius_m * angle);
    out.push_back({Vector3d(straight + bend_radius_m * std::sin(phi) + after * std::cos(phi), 0,
                            bend_radius_m * (1 - std::cos(phi)) + after * std::sin(phi)),
                   radius_m});
  }
  return out;
}

}  // namespace ostium::core
