#include "app/session/scene/angioscopy.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel_loop.h"
#include "core/rod/introducer.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/treatment/stent_shape.h"

namespace ostium::app {

namespace {

using Eigen::Vector3d;

constexpr double before_m = 4e-3, beyond_m = 4e-3;  // of the camera before the branch; of what it looks at in it
constexpr double near_m = 30e-3;                    // of what is drawn
constexpr double half_angle = 1.0;                  // tangent of half the picture's angle
constexpr double lamp_m = 7e-3;                     // at which its light has halved
constexpr int samples = 2;                          // a side, per pixel
const Vector3d wall_rgb(225, 120, 105), strut_rgb(235, 235, 245), rod_rgb(120, 150, 190);

/// A strut, or an element of an instrument: a cylinder with round ends.
struct Capsule {
  Vector3d from, to;
  double radius_m = 0;
  Vector3d rgb;
};

struct Seen {
  double distance_m = near_m;
  Vector3d normal = Vector3d::Zero(), rgb = Vector3d::Zero();
};

/// The ray's first point in a capsule, if it is nearer than what was seen (Ericson, Real-Time Collision Detection,
/// 2005, 5.3.7, for the cylinder; its ends as spheres).
void look_at(const Capsule& c, const Vector3d& eye, const Vector3d& ray, Seen& seen) {
  const Vector3d axis = c.to - c.from, off = eye - c.from;
  const double length2 = axis.squaredNorm(), along_ray = axis.dot(ray), along_off = axis.dot(off);
  const auto take = [&](double t, const Vector3d& middle) {
    if (t > 0 && t < seen.distance_m) seen = {t, (eye + t * ray - middle).normalized(), c.rgb};
  };
  const double a = length2 - along_ray * along_ray, b = length2 * off.dot(ray) - along_off * along_ray,
               k = length2 * (off.squaredNorm() - c.radius_m * c.radius_m) - along_off * along_off;
  if (const double root = b * b - a * k; a > 1e-30 && root > 0) {
    const double t = (-b - std::sqrt(root)) / a, share = (along_off + t * along_ray) / length2;
    if (share >= 0 && share <= 1) return take(t, c.from + share * axis);
  }
  for (const Vector3d& end : {c.from, c.to}) {
    const double to = (end - eye).dot(ray), past2 = (eye + to * ray - end).squaredNorm(), r2 = c.radius_m * c.radius_m;
    if (past2 < r2) take(to - std::sqrt(r2 - past2), end);
  }
}

std::vector<Capsule> capsules_near(const SessionModel& model, const SessionState& state, const Vector3d& eye) {
  std::vector<Capsule> all;
  const auto add = [&](const Vector3d& from, const Vector3d& to, double radius_m, const Vector3d& rgb) {
    if (((from + to) / 2 - eye).norm() < near_m && (to - from).norm() > 1e-9) all.push_back({from, to, radius_m, rgb});
  };
  const Coronaries& c = *model.vessel->coronaries;
  const vascular::LumenMoment at = moment(model, state);
  for (std::size_t i = 0; i < state.treatment.stents.size(); ++i) {
    const vascular::StentState& stent = state.treatment.stents[i];
    const vascular::StentModel& own = model.treatment.stents[i];
    if (stent.where != vascular::StentState::deployed || stent.branch < 0) continue;
    const auto points =
        is_tied(stent)
            ? points_on_wall(own, stent, *c.patient, *c.shape, state.blood.radius_m, at)
            : points_on_path(own, stent, c.map, model.treatment.paths[static_cast<std::size_t>(stent.branch)], at);
    for (const auto& [from, to] : struts_of(own))
      add(points[static_cast<std::size_t>(from)], points[static_cast<std::size_t>(to)], own.strut_m / 2, strut_rgb);
  }
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& own = state.rods.rods[t];
    if (!in_body(rod, own)) continue;
    for (int e = own.first; e < rod.elements; ++e)
      add(own.position[e], own.position[e + 1], rod.radius.at(0)[static_cast<std::size_t>(e)], rod_rgb);
  }
  return all;
}

struct Camera {
  Vector3d eye, ahead, right, up;
};

Camera camera_at(const SessionModel& model, const SessionState& state, const std::string& branch) {
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const int b = tree.branch(branch);
  if (b < 0 || tree.branches[static_cast<std::size_t>(b)].parent < 0)
    throw data::LoadError(fmt::format("{}: expected a branch that leaves another coronary artery", branch));
  const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(b)];
  const int cell = tree.branches[static_cast<std::size_t>(b)].parent_cell;
  const auto at = std::find(path.cells.begin(), path.cells.end(), cell) - path.cells.begin();
  const double leaves_m = path.s_m[static_cast<std::size_t>(at)];
  const vascular::LumenMap& map = model.vessel->coronaries->map;
  const vascular::LumenMoment now = moment(model, state);
  const Vector3d eye = frame_at(map, path, std::max(path.s_m.front(), leaves_m - before_m), now).centre,
                 mouth = frame_at(map, path, leaves_m + beyond_m, now).centre;
  Camera camera{eye, (mouth - eye).normalized(), {}, {}};
  const Vector3d head = std::fabs(camera.ahead.z()) < 0.9 ? Vector3d(Vector3d::UnitZ()) : Vector3d(Vector3d::UnitY());
  camera.right = camera.ahead.cross(head).normalized(), camera.up = camera.right.cross(camera.ahead);
  return camera;
}

}  // namespace

Angioscopy look_inside(const SessionModel& model, const SessionState& state, const std::string& branch, int pixels) {
  const Camera camera = camera_at(model, state, branch);
  vascular::Mesh lumen{.vertices = {}, .triangles = model.vessel->coronaries->patient->lumen.triangles};
  model.vessel->coronaries->shape->at(state.blood.radius_m, moment(model, state), lumen.vertices);
  const vascular::BoundingVolumeHierarchy surface(lumen);
  const std::vector<Capsule> capsules = capsules_near(model, state, camera.eye);
  const auto colour = [&](double x, double y) -> Vector3d {
    const Vector3d ray = (camera.ahead + half_angle * (x * camera.right + y * camera.up)).normalized();
    Seen seen;
    if (const auto hits = surface.hits(camera.eye, ray, near_m); !hits.empty()) {
      const auto& triangle = lumen.triangles[static_cast<std::size_t>(hits.front().triangle)];
      const auto corner = [&](int k) { return lumen.vertices[static_cast<std::size_t>(triangle[k])]; };
      const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
      seen = {hits.front().distance_m, normal.dot(ray) > 0 ? Vector3d(-normal) : normal, wall_rgb};
    }
    for (const Capsule& one : capsules) look_at(one, camera.eye, ray, seen);
    const double far = seen.distance_m / lamp_m;
    return (0.15 + 0.85 * std::max(0.0, -seen.normal.dot(ray))) / (1 + far * far) * seen.rgb;
  };
  Angioscopy out{pixels, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * pixels * pixels))};
  core::in_parallel(static_cast<std::size_t>(pixels), [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int column = 0; column < pixels; ++column) {
        Vector3d sum = Vector3d::Zero();
        for (int i = 0; i < samples * samples; ++i) {
          const double x = (column + (i % samples + 0.5) / samples) / pixels,
                       y = (static_cast<double>(row) + (i / samples + 0.5) / samples) / pixels;
          sum += colour(2 * x - 1, 1 - 2 * y) / (samples * samples);
        }
        for (int k = 0; k < 3; ++k)
          out.rgb[3 * (row * static_cast<std::size_t>(pixels) + static_cast<std::size_t>(column)) +
                  static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::clamp(1.5 * sum[k], 0.0, 255.0));
      }
  });
  return out;
}

}  // namespace ostium::app
