#include "app/command_line/read_vessel.h"

#include <algorithm>

#include "core/base/units.h"
#include "data/catalogue/case/markups_file.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/mesh/length_unit.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

vascular::MeshFile read_vessel(const std::string& path, vascular::LengthUnit unit, double weld_m) {
  if (!data::is_markups_file(path)) {
    if (vascular::has_mesh_ending(path)) return read_mesh(path, unit, weld_m);
    throw vascular::MeshError(path + ": its ending names nothing that is read as a vessel; expected a mesh (" +
                              vascular::listed_mesh_endings() + ") or centrelines of 3D Slicer (.mrk.json)");
  }
  const std::vector<vascular::Tube> tubes = data::load_markups(path);
  vascular::ContourSettings settings;
  for (const vascular::Tube& tube : tubes)
    for (const vascular::TubeNode& node : tube.nodes)
      settings.finest_m = std::min(settings.finest_m, node.radius_m / 2.5);  // some 16 triangles around
  vascular::MeshFile file;
  file.mesh = contour(vascular::TubeUnion(tubes), settings).mesh;
  for (Eigen::Vector3d& p : file.mesh.vertices) p *= metres(unit) / units::mm;
  return file;
}

}  // namespace ostium::app
