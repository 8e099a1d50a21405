#include "vascular/patient/ventricle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/math/alignment.h"
#include "vascular/heart/heart.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/motion/heart_motion.h"

namespace ostium::vascular {

using Eigen::Vector3d;

namespace {

using units::mm;
constexpr double below_m = 3 * mm, above_m = 5 * mm;  // distance from the annulus' plane within which the leaflets lie
constexpr double ring_spacing_m = 5 * mm;

/// Connected triangles of the floor around the axis, including the one nearest to it.
std::vector<int> leaflets(const core::SurfaceDescription& wall, const Landmarks& marks) {
  const std::vector<Vector3d>& p = wall.frames[0];
  const auto near = [&](int v) {
    const Vector3d from = p[v] - marks.p_annulus;
    const double height = from.dot(marks.root_axis);
    return height > -below_m && height < above_m && (from - height * marks.root_axis).norm() < valve_radius_m;
  };
  std::map<int, std::vector<int>> of_vertex;
  int first = -1;
  double least = 1;
  for (int t = 0; t < static_cast<int>(wall.triangles.size()); ++t) {
    const auto& [a, b, c] = wall.triangles[t];
    if (!near(a) || !near(b) || !near(c)) continue;
    // Only triangles that face the ventricle.
    if ((p[b] - p[a]).cross(p[c] - p[a]).dot(marks.root_axis) > 0) continue;
    for (int v : {a, b, c}) of_vertex[v].push_back(t);
    const Vector3d from = (p[a] + p[b] + p[c]) / 3 - marks.p_annulus;
    const double aside = (from - from.dot(marks.root_axis) * marks.root_axis).norm();
    if (aside < least) least = aside, first = t;
  }
  if (first < 0) return {};
  std::vector<int> found = {first};
  std::vector<char> taken(wall.triangles.size(), 0);
  taken[first] = 1;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int v : wall.triangles[found[k]])
      for (int t : of_vertex[v])
        if (!taken[t]) taken[t] = 1, found.push_back(t);
  std::sort(found.begin(), found.end());
  return found;
}

/// The rim of the leaflets, in the order of their triangles; empty unless it is a single loop.
std::vector<int> rim_of(const core::SurfaceDescription& wall, const std::vector<int>& door) {
  std::map<std::pair<int, int>, int> edges;
  for (int t : door)
    for (int k = 0; k < 3; ++k) ++edges[{wall.triangles[t][k], wall.triangles[t][(k + 1) % 3]}];
  std::map<int, int> next;
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first}))
      if (count != 1 || !next.emplace(edge.first, edge.second).second) return {};
  if (next.size() < 8) return {};
  std::vector<int> rim = {next.begin()->first};
  while (rim.size() <= next.size()) {
    const auto at = next.find(rim.back());
    if (at == next.end()) return {};
    if (at->second == rim.front()) break;
    rim.push_back(at->second);
  }
  return rim.size() == next.size() ? rim : std::vector<int>{};
}

/// The centreline: outflow tract, then the ventricle's axis.
Tube course_of(const Landmarks& m) {
  const Vector3d axis = m.p_lv_apex - m.p_lv_base, out = -m.root_axis;
  const auto along = [&](double s) { return Vector3d(m.p_lv_base + s * axis); };
  return make_tube("left ventricle", -1,
                   {{m.p_annulus + 3 * mm * out, valve_radius_m + 1 * mm},
                    {m.p_annulus + 12 * mm * out, 10 * mm},
                    {along(0.50), 20 * mm},
                    {along(0.68), 15 * mm},
                    {along(0.86), 4 * mm}});
}

}  // namespace

bool valve_is_open(double phase) { return phase > valve_opens && phase < valve_closes; }

Ventricle add_ventricle(const Patient& patient, core::SurfaceDescription& wall) {
  const Landmarks& marks = patient.anatomy.landmarks;
  if (!patient.anatomy.aorta) return {};
  const std::vector<int> door = leaflets(wall, marks), rim = rim_of(wall, door);
  if (rim.empty()) return {};
  const Tube middle = course_of(marks);
  const int around = static_cast<int>(rim.size());
  const int rings = std::max(4, static_cast<int>(std::lround(middle.length_m() / ring_spacing_m)));
  const std::vector<Vector3d> root = wall.frames[0];

  // Rings around the centreline, each vertex at the angle of its rim vertex; transported without twist.
  Vector3d along = -marks.root_axis;
  std::vector<Vector3d> side;
  for (int j = 0; j < around; ++j) {
    const Vector3d from = root[rim[j]] - marks.p_annulus;
    side.push_back((from - from.dot(along) * along).normalized());
  }
  std::vector<Vector3d> added;
  Ventricle out;
  for (int k = 0; k < rings; ++k) {
    const double s = middle.length_m() * k / (rings - 1);
    const TubeNode node = middle.at(s);
    const Vector3d tangent = middle.tangent(s);
    const Eigen::Quaterniond turn = core::rotation_between(along, tangent);
    along = tangent;
    for (Vector3d& direction : side) direction = turn * direction, added.push_back(node.p + node.radius_m * direction);
    out.spheres.push_back({node.p, node.radius_m, s});
  }
  added.push_back(middle.nodes.back().p + middle.nodes.back().radius_m * along);

  const int first = static_cast<int>(root.size());
  const auto vertex = [&](int ring, int j) { return ring < 0 ? rim[j % around] : first + ring * around + j % around; };
  // Same winding along the rim as the leaflets, which these triangles replace in the closed surface.
  for (int k = -1; k + 1 < rings; ++k)
    for (int j = 0; j < around; ++j) {
      wall.triangles.push_back({vertex(k, j), vertex(k, j + 1), vertex(k + 1, j + 1)});
      wall.triangles.push_back({vertex(k, j), vertex(k + 1, j + 1), vertex(k + 1, j)});
    }
  const int apex = first + rings * around;
  for (int j = 0; j < around; ++j) wall.triangles.push_back({vertex(rings - 1, j), vertex(rings - 1, j + 1), apex});

  const HeartMotion motion(marks);
  const auto frames = static_cast<double>(wall.frames.size());
  for (std::size_t f = 0; f < wall.frames.size(); ++f) {
    const double share = contraction(static_cast<double>(f) / frames);
    for (const Vector3d& p : added) wall.frames[f].push_back(p + share * motion.displacement(p));
    out.centres.emplace_back();
    for (const TreeSphere& sphere : out.spheres)
      out.centres.back().push_back(sphere.p + share * motion.displacement(sphere.p));
  }
  if (!wall.sway.empty())
    for (const Vector3d& p : added) wall.sway.push_back(motion.breath_displacement(p, 1));
  wall.door = door, wall.door_passes_m = valve_passes_m;
  return out;
}

}  // namespace ostium::vascular
