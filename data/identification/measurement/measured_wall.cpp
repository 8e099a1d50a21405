#include "data/identification/measurement/measured_wall.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::data {

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
