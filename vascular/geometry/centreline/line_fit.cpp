#include "vascular/geometry/centreline/line_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr double whole_m = 1;       // the wall is nearer than this everywhere
constexpr double fineness = 1e-3;   // of a sphere's middle, in radii
constexpr double clear_of_lid = 2;  // radii from the tip of a line, which may lie on the rim
constexpr double ray_reach = 3;     // radii: a ray that gets farther looks into a branch
constexpr double most_along = 0.5;  // cosine: a wall nearer to the line's direction is the lid
constexpr int rays = 12, recentred = 4;

Eigen::Vector3d across(const Eigen::Vector3d& v, const Eigen::Vector3d& along) { return v - v.dot(along) * along; }

/// Smooths the row of voxels, and takes out most of their distance to the middle.
void smooth_line(std::vector<Eigen::Vector3d>& line, const BoundingVolumeHierarchy& wall, double voxel_m) {
  const std::size_t n = line.size();
  for (int round = 0; round < 8; ++round) {
    std::vector<Eigen::Vector3d> next = line;
    for (std::size_t i = 1; i + 1 < n; ++i) next[i] = (line[i - 1] + 2 * line[i] + line[i + 1]) / 4;
    line = std::move(next);
    for (std::size_t i = 1; i + 1 < n && round < 5; ++i) {
      // Move half-way to the midpoint between the nearest wall point and the wall opposite.
      const Eigen::Vector3d along = (line[i + 1] - line[i - 1]).normalized();
      const BoundingVolumeHierarchy::Nearest near = wall.nearest(line[i], whole_m);
      Eigen::Vector3d away = across(line[i] - near.point, along);
      if (away.norm() < 1e-9) continue;
      away.normalize();
      const double step = std::min(voxel_m / 2, near.distance_m / 4);
      if (wall.nearest(line[i] + step * away, whole_m).distance_m > near.distance_m + step / 2)
        line[i] += step * away / 2;
    }
  }
}

/// Climbs across the line to where the sphere is largest, but no farther than a voxel: a side branch has a wider place.
void enlarge(TreeSphere& sphere, const Eigen::Vector3d& along, const BoundingVolumeHierarchy& wall, double voxel_m) {
  const Eigen::Vector3d from = sphere.p;
  BoundingVolumeHierarchy::Nearest near = wall.nearest(sphere.p, whole_m);
  // Never as far as the wall, behind which there would be room, too.
  for (double step = std::min(voxel_m, near.distance_m) / 2; step > fineness * near.distance_m;) {
    const Eigen::Vector3d away = across(sphere.p - near.point, along);
    if (away.norm() < 1e-9) break;
    const Eigen::Vector3d p = sphere.p + step * away.normalized();
    const BoundingVolumeHierarchy::Nearest there = wall.nearest(p, whole_m);
    if (there.distance_m > near.distance_m && (p - from).norm() <= voxel_m)
      sphere.p = p, near = there;
    else
      step /= 2;
  }
  sphere.radius_m = near.distance_m;
}

void measure_lengths(std::vector<TreeSphere>& spheres) {
  for (std::size_t i = 0; i < spheres.size(); ++i)
    spheres[i].s_m = i == 0 ? 0 : spheres[i - 1].s_m + (spheres[i].p - spheres[i - 1].p).norm();
}

/// The middle of the lumen across the line, by what rays meet.
Eigen::Vector3d middle_across(Eigen::Vector3d p, const Eigen::Vector3d& along, double radius_m,
                              const BoundingVolumeHierarchy& wall) {
  const Eigen::Vector3d x = along.unitOrthogonal(), y = along.cross(x);
  for (int round = 0; round < recentred; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < rays / 2; ++k) {
      const double angle = 2 * units::pi * k / rays;
      const Eigen::Vector3d out = std::cos(angle) * x + std::sin(angle) * y;
      const auto there = wall.hits(p, out, ray_reach * radius_m), back = wall.hits(p, -out, ray_reach * radius_m);
      if (there.empty() || back.empty()) continue;
      sum += (there.front().distance_m - back.front().distance_m) * out;
    }
    p += 2 * sum / rays;
  }
  return p;
}

/// The first sphere from the tip on that the lid does not make narrow, if there is one before the other end.
std::optional<std::size_t> last_clear(const std::vector<TreeSphere>& spheres) {
  double widest = 0;
  for (std::size_t i = spheres.size(); i-- > 1;) {
    widest = std::max(widest, spheres[i].radius_m);
    if (spheres.back().s_m - spheres[i].s_m >= clear_of_lid * widest) return i;
  }
  return {};
}

}  // namespace

std::vector<TreeSphere> fitted_spheres(std::vector<Eigen::Vector3d> line, const BoundingVolumeHierarchy& wall,
                                       double voxel_m) {
  smooth_line(line, wall, voxel_m);
  std::vector<TreeSphere> spheres;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double radius = wall.nearest(line[i], whole_m).distance_m;
    if (!spheres.empty() && (line[i] - spheres.back().p).norm() < radius / 2 && i + 1 < line.size()) continue;
    spheres.push_back({line[i], radius, 0});
  }
  for (std::size_t i = 1; i + 1 < spheres.size(); ++i)
    enlarge(spheres[i], (spheres[i + 1].p - spheres[i - 1].p).normalized(), wall, voxel_m);
  measure_lengths(spheres);
  return spheres;
}

void carry_to_lid(std::vector<TreeSphere>& spheres, const BoundingVolumeHierarchy& wall, double beyond) {
  const std::optional<std::size_t> clear = last_clear(spheres);
  if (!clear) return trim(spheres);
  TreeSphere at = spheres[*clear];
  Eigen::Vector3d along = (at.p - spheres[*clear - 1].p).normalized();
  const double farthest = spheres.back().s_m - at.s_m + beyond * at.radius_m;
  const double narrowest = at.radius_m / 4;  // where it narrows further, no lid of this vessel is ahead
  std::vector<TreeSphere> on;
  for (double gone = 0; gone < farthest && at.radius_m > narrowest;) {
    const auto ahead = wall.hits(at.p, along, farthest);
    if (ahead.empty()) return;
    const double step = at.radius_m / 2;
    if (ahead.front().distance_m < 1.5 * step) {
      at.p += ahead.front().distance_m * along;
      on.push_back(at);
      spheres.resize(*clear + 1);
      spheres.insert(spheres.end(), on.begin(), on.end());
      return measure_lengths(spheres);
    }
    const Eigen::Vector3d next = middle_across(at.p + step * along, along, at.radius_m, wall);
    along = (along + (next - at.p).normalized()).normalized();
    at.p = next;
    const BoundingVolumeHierarchy::Nearest near = wall.nearest(at.p, whole_m);
    if (std::fabs((near.point - at.p).dot(along)) < most_along * near.distance_m) at.radius_m = near.distance_m;
    on.push_back(at);
    gone += step;
  }
}

void trim(std::vector<TreeSphere>& spheres, double least) {
  while (spheres.size() > 2 && spheres.back().radius_m < least * spheres[spheres.size() - 2].radius_m)
    spheres.pop_back();
}

void turn_round(std::vector<TreeSphere>& spheres) {
  std::reverse(spheres.begin(), spheres.end());
  measure_lengths(spheres);
}

}  // namespace ostium::vascular
