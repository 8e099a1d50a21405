#include "data/identification/measurement/measured_wall.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;

/// Generalised winding number of a point (van Oosterom, Strackee 1983): 1 inside.
double winding_number(const vascular::Mesh& mesh, const Vector3d& p) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

std::shared_ptr<const core::SurfaceDescription> read_wall(const MeasurementSet& set) {
  const std::string mesh = (std::filesystem::path(set.file).parent_path() / set.vessel->mesh).string();
  const auto fail = [&](const std::string& what) {
    throw LoadError(set.file + ": environment.vessel.mesh is \"" + set.vessel->mesh + "\": " + what);
  };
  const vascular::LengthUnit unit = set.vessel->units == "mm"   ? vascular::LengthUnit::millimetre
                                    : set.vessel->units == "cm" ? vascular::LengthUnit::centimetre
                                    : set.vessel->units == "m"  ? vascular::LengthUnit::metre
                                                                : vascular::LengthUnit::inch;
  vascular::Mesh read;
  try {
    read = read_mesh(mesh, unit).mesh;
  } catch (const vascular::MeshError& error) {
    fail(error.what());
  }
  if (volume_m3(read) < 0)
    for (auto& t : read.triangles) std::swap(t[1], t[2]);
  for (const Experiment& e : set.experiments)
    if (winding_number(read, e.base.p_W) < 0.5)
      fail(fmt::format("{}.base.position_mm lies outside of it; expected a point within the lumen", e.place));
  auto wall = std::make_shared<core::SurfaceDescription>();
  wall->frames = {read.vertices};
  wall->triangles = read.triangles;
  return wall;
}

}  // namespace ostium::data
