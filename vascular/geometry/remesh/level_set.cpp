#include "vascular/geometry/remesh/level_set.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>

#include "vascular/geometry/mesh/winding.h"
#include "vascular/geometry/remesh/openvdb_module.h"

namespace ostium::vascular {

namespace {

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

Mesh outer_surface(const Mesh& closed, double voxel_m) {
  Contour* const contour = contour_of_module();
  const WindingNumber winding(closed);
  const std::vector<std::array<int, 3>> wall = bordering_triangles(closed, winding, voxel_m / 20);
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
