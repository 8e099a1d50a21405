#include "vascular/treatment/stent_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

namespace {

/// Angle of point j of a ring; the first crown is at the side direction of the path's frame.
double angle_of(const StentModel& m, int j) { return units::pi * j / m.crowns; }

/// A stent too small for its vessel lies against one side: its gap is 0 there, and twice the mean on the opposite side.
double gap_of(const StentModel& m, const StentState& s, const VesselPath& path, const PlaqueState& wall, int point) {
  const int around = 2 * m.crowns, ring = point / around;
  const double at = s.middle_m + s.shift_m + s.along_m[point];
  const double room = path.value(wall.radius_m, at) - s.radius_m[ring] - m.strut_m;
  return std::max(0.0, room) * (1 - std::cos(angle_of(m, point % around)));
}

}  // namespace

std::vector<std::pair<int, int>> struts_of(const StentModel& m) {
  std::vector<std::pair<int, int>> out;
  const int around = 2 * m.crowns, every = m.crowns / m.links;
  for (int k = 0; k < m.rings; ++k) {
    for (int j = 0; j < around; ++j) out.emplace_back(k * around + j, k * around + (j + 1) % around);
    if (k + 1 == m.rings) break;
    for (int crown = k % 2; crown < m.crowns; crown += every) {
      const int j = (2 * crown + 1) % around;
      out.emplace_back(k * around + j, (k + 1) * around + j);
    }
  }
  return out;
}

PathFrame frame_at(const LumenMap& map, const VesselPath& path, double s_m, double phase, double breath) {
  const auto centre = [&](int i) {
    const int last = static_cast<int>(path.cells.size()) - 1;
    return map.centre(static_cast<std::size_t>(path.cells[std::clamp(i, 0, last)]), phase, breath);
  };
  const VesselPath::Place place = path.at(s_m);
  PathFrame f;
  f.centre = (1 - place.share) * centre(place.index) + place.share * centre(place.index + 1);
  Eigen::Vector3d side = Eigen::Vector3d::UnitX(), along = (centre(2) - centre(0)).normalized();
  if (std::fabs(along.x()) > 0.9) side = Eigen::Vector3d::UnitY();
  side = (side - side.dot(along) * along).normalized();
  for (int i = 0; i <= place.index; ++i) {
    const Eigen::Vector3d next = (centre(i + 2) - centre(i - 1)).normalized();
    side = Eigen::Quaterniond::FromTwoVectors(along, next) * side;
    along = next;
  }
  f.along = along, f.side = (side - side.dot(along) * along).normalized(), f.up = f.along.cross(f.side);
  return f;
}

std::vector<Eigen::Vector3d> points_on_path(const StentModel& m, const StentState& s, const LumenMap& map,
                                            const VesselPath& path, double phase, double breath) {
  std::vector<Eigen::Vector3d> out;
  const int around = 2 * m.crowns;
  for (int i = 0; i < m.points(); ++i) {
    const PathFrame f = frame_at(map, path, s.middle_m + s.shift_m + s.along_m[i], phase, breath);
    const double a = angle_of(m, i % around), r = s.radius_m[i / around] + m.strut_m / 2;
    out.push_back(f.centre + r * (std::cos(a) * f.side + std::sin(a) * f.up));
  }
  return out;
}

bool is_tied(const StentState& s) { return !s.ties.empty() && s.ties.front().triangle >= 0; }

void tie_to_wall(const StentModel& m, const Patient& patient, const WallShape& shape, const LumenMap& map,
                 const VesselPath& path, const PlaqueState& wall, double phase, StentState& s) {
  Mesh mesh{.vertices = {}, .triangles = patient.lumen.triangles};
  shape.at(wall.radius_m, phase, 0, mesh.vertices);
  const BoundingVolumeHierarchy surface(mesh);
  const std::vector<Eigen::Vector3d> points = points_on_path(m, s, map, path, phase);
  for (int i = 0; i < m.points(); ++i) {
    const auto found = surface.nearest(points[i], 10e-3);
    const auto& [a, b, c] = mesh.triangles[found.triangle];
    const Eigen::Vector3d p = mesh.vertices[a], u = mesh.vertices[b] - p, v = mesh.vertices[c] - p, w = found.point - p;
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v), d = uu * vv - uv * uv;
    s.ties[i] = {found.triangle, (vv * wu - uv * wv) / d, (uu * wv - uv * wu) / d,
                 m.strut_m / 2 + gap_of(m, s, path, wall, i)};
  }
}

std::vector<Eigen::Vector3d> points_on_wall(const StentModel& m, const StentState& s, const Patient& patient,
                                            const WallShape& shape, std::span<const double> radius_m, double phase,
                                            double breath) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < m.points(); ++i) {
    const StentTie& tie = s.ties[i];
    const auto& triangle = patient.lumen.triangles[static_cast<std::size_t>(tie.triangle)];
    const auto corner = [&](int k) {
      return shape.vertex(static_cast<std::size_t>(triangle[k]), radius_m, phase, breath);
    };
    const Eigen::Vector3d a = corner(0), u = corner(1) - a, v = corner(2) - a;
    out.push_back(a + tie.u * u + tie.v * v - tie.depth_m * u.cross(v).normalized());
  }
  return out;
}

std::vector<double> gaps(const StentModel& m, const StentState& s, const VesselPath& path, const PlaqueState& wall) {
  std::vector<double> out;
  for (int i = 0; i < m.points(); ++i) out.push_back(gap_of(m, s, path, wall, i));
  return out;
}

Apposition apposition(const StentModel& m, const StentState& s, const VesselPath& path, const PlaqueState& wall) {
  Apposition out{.share = 0};
  for (int i = 0; i < m.points(); ++i) {
    const double gap = gap_of(m, s, path, wall, i);
    out.share += gap <= apposed_m ? 1.0 / m.points() : 0;
    out.worst_m = std::max(out.worst_m, gap);
  }
  return out;
}

}  // namespace ostium::vascular
