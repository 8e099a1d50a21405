#include "vascular/geometry/remesh/level_set.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>

#include "vascular/geometry/remesh/openvdb_module.h"
#include "vascular/geometry/remesh/winding.h"

namespace ostium::vascular {

namespace {

constexpr std::size_t most_sampled = 400'000;

/// Triangles that border on the outside; those inside another piece would spoil distances.
std::vector<std::array<int, 3>> bordering(const Mesh& mesh, const WindingNumber& winding, double step_m) {
  if (mesh.triangles.size() > most_sampled) return mesh.triangles;
  std::vector<std::array<int, 3>> kept;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Eigen::Vector3d area = (b - a).cross(c - a);
    if (area.isZero(0)) continue;
    const Eigen::Vector3d out = step_m * area.normalized();
    bool borders = false;
    for (const Eigen::Vector3d& w :
         {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(8, 1, 1), Eigen::Vector3d(1, 8, 1), Eigen::Vector3d(1, 1, 8)}) {
      const Eigen::Vector3d p = (w[0] * a + w[1] * b + w[2] * c) / w.sum();
      borders = winding.inside(p - out) != winding.inside(p + out);
      if (borders) break;
    }
    if (borders) kept.push_back(t);
  }
  return kept;
}

/// The function of the module, which stays loaded.
Contour* contour_of_module() {
  static Contour* const contour = [] {
    // By its bare name: the run path of what asks says where it lies, in a build and in an installation.
    void* const module = dlopen(openvdb_module, RTLD_NOW | RTLD_LOCAL);
    if (!module)
      throw MeshError(fmt::format("mending a mesh: {}; build or install {} beside ostium, and libopenvdb", dlerror(),
                                  openvdb_module));
    void* const function = dlsym(module, contour_function);
    if (!function)
      throw MeshError(fmt::format("mending a mesh: {}; install the {} of this build", dlerror(), openvdb_module));
    return reinterpret_cast<Contour*>(function);
  }();
  return contour;
}

}  // namespace

std::vector<std::array<int, 3>> bordering_triangles(const Mesh& closed, double step_m) {
  return bordering(closed, WindingNumber(closed), step_m);
}

Mesh outer_surface(const Mesh& closed, double voxel_m) {
  Contour* const contour = contour_of_module();
  const WindingNumber winding(closed);
  const std::vector<std::array<int, 3>> wall = bordering(closed, winding, voxel_m / 20);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : closed.vertices) box.extend(p);
  // Offset from the round numbers at which people place vertices and flat ends.
  const Eigen::Vector3d origin = box.min() - voxel_m * Eigen::Vector3d(0.137, 0.271, 0.313);
  std::vector<Eigen::Vector3f> corners;
  corners.reserve(closed.vertices.size());
  for (const Eigen::Vector3d& p : closed.vertices) corners.emplace_back(((p - origin) / voxel_m).cast<float>());
  const auto inside = [&](const Eigen::Vector3i& at) { return winding.inside(origin + voxel_m * at.cast<double>()); };
  const ContouredSurface surface = contour(corners, wall, inside);
  const std::vector<Eigen::Vector3f>& points = surface.points;

  Mesh mesh;
  mesh.vertices.reserve(points.size());
  for (const Eigen::Vector3f& p : points) mesh.vertices.push_back(origin + voxel_m * p.cast<double>());
  mesh.triangles.reserve(surface.triangles.size() + 2 * surface.quads.size());
  const auto add = [&](unsigned a, unsigned b, unsigned c) {
    mesh.triangles.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
  };
  for (const auto& t : surface.triangles) add(t[0], t[1], t[2]);
  for (const auto& q : surface.quads) {
    const auto length = [&](unsigned a, unsigned b) {
      const Eigen::Vector3f d = points[a] - points[b];
      return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    };
    if (length(q[0], q[2]) <= length(q[1], q[3])) {
      add(q[0], q[1], q[2]);
      add(q[0], q[2], q[3]);
    } else {
      add(q[0], q[1], q[3]);
      add(q[1], q[2], q[3]);
    }
  }
  return mesh;
}

}  // namespace ostium::vascular
