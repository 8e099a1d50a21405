#include "app/gates/test_vessel.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/implicit/contour.h"

namespace ostium::app::gates {

using Eigen::Vector3d;

namespace {

using units::pi;
constexpr int frames = 24;

/// A descending part along x, an arch of 35 mm radius, and back down to a root.
std::vector<vascular::CoursePoint> trunk() {
  std::vector<vascular::CoursePoint> course;
  for (double x = -0.01; x < 0.2; x += 0.03) course.push_back({Vector3d(x, 0.006 * std::sin(x / 0.05), 0), 0});
  const Vector3d turn = course.back().p + Vector3d(0.02, 0, 0);
  for (double a = 0; a < pi + 0.01; a += pi / 6)
    course.push_back({turn + 0.035 * Vector3d(std::sin(a), 0.3 * std::sin(a), 1 - std::cos(a)), 0});
  course.push_back({course.back().p + Vector3d(-0.03, 0, 0), 0});
  course.front().radius_m = 5e-3, course.back().radius_m = 13e-3;
  course[7].radius_m = 9e-3;
  return course;
}

std::vector<vascular::CoursePoint> branch(const Vector3d& root, double side) {
  std::vector<vascular::CoursePoint> course;
  for (double s : {0.0, 0.006, 0.015, 0.03, 0.045, 0.06, 0.075})
    course.push_back({root + Vector3d(-0.4 * s - 0.2 * s * s / 0.075, side * (0.004 + 0.9 * s - 6 * s * s),
                                      0.012 * std::sin(s / 0.012) + 0.3 * s),
                      0});
  course.front().radius_m = 1.9e-3, course[2].radius_m = 1.5e-3, course.back().radius_m = 1.3e-3;
  return course;
}

/// The vessel's far side oscillates and moves along a loop, like the surface of a heart.
Vector3d beat(const Vector3d& p, const Vector3d& root, double beat_m, double phase) {
  const double from_trunk = std::max(0.0, std::fabs(p.y() - root.y()) - 0.01);
  const double share = std::min(1.0, from_trunk / 0.04);
  const Vector3d swing(0.5 * std::sin(phase), 0.4 * std::sin(phase) + 0.2 * std::sin(2 * phase),
                       0.5 * (1 - std::cos(phase)));
  return p + beat_m * share * share * (3 - 2 * share) * swing;
}

std::vector<Vector3d> points(const vascular::Tube& tube) {
  std::vector<Vector3d> out;
  for (const vascular::TubeNode& n : tube.nodes) out.push_back(n.p);
  return out;
}

}  // namespace

TestVessel test_vessel(double beat_m) {
  std::vector<vascular::Tube> tubes = {make_tube("trunk", -1, trunk())};
  const Vector3d root = tubes[0].nodes.back().p;
  tubes.push_back(make_tube("branch 1", 0, branch(root, 1)));
  tubes.push_back(make_tube("branch 2", 0, branch(root, -1)));
  vascular::ContourSettings settings;
  settings.cell_at_1_mm_m = 0.55e-3;
  settings.finest_m = 0.3e-3;
  const vascular::Mesh mesh = contour(vascular::TubeUnion(tubes), settings).mesh;

  TestVessel out;
  out.wall.triangles = mesh.triangles;
  for (int f = 0; f < frames; ++f) {
    auto& frame = out.wall.frames.emplace_back();
    for (const Vector3d& p : mesh.vertices) frame.push_back(beat(p, root, beat_m, 2 * pi * f / frames));
  }
  out.entry_W = Vector3d(0, 0, 0);
  for (int b : {0, 1}) {
    out.ways_W[b] = points(tubes[0]);
    for (const Vector3d& p : points(tubes[b + 1])) out.ways_W[b].push_back(p);
  }
  return out;
}

}  // namespace ostium::app::gates
