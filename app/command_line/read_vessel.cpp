#include "app/command_line/read_vessel.h"

#include <algorithm>

#include "core/base/units.h"
#include "data/catalogue/case/markups_file.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/mesh/length_unit.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

namespace {

using Eigen::Vector3d;

bool lies_in_another(const Vector3d& p, const std::vector<vascular::Tube>& tubes, std::size_t own) {
  for (std::size_t t = 0; t < tubes.size(); ++t) {
    const vascular::TubeNode near = tubes[t].at(nearest_s(tubes[t], p));
    if (t != own && (near.p - p).norm() < near.radius_m) return true;
  }
  return false;
}

/// A centreline goes from lid to lid, but tubes end in balls: what of these lies beyond the first or last point is laid
/// flat, where no other vessel goes on.
void flatten_ends(const std::vector<vascular::Tube>& tubes, vascular::Mesh& mesh) {
  for (std::size_t t = 0; t < tubes.size(); ++t) {
    const vascular::Tube& tube = tubes[t];
    const auto flatten = [&](const vascular::TubeNode& end, const Vector3d& outwards) {
      if (lies_in_another(end.p, tubes, t)) return;
      for (Vector3d& p : mesh.vertices)
        if (const double beyond_m = (p - end.p).dot(outwards); beyond_m > 0 && (p - end.p).norm() < 1.1 * end.radius_m)
          p -= beyond_m * outwards;
    };
    flatten(tube.nodes.front(), -tube.tangent(0));
    flatten(tube.nodes.back(), tube.tangent(tube.length_m()));
  }
}

}  // namespace

vascular::MeshFile read_vessel(const std::string& path, vascular::LengthUnit unit, double weld_m) {
  if (!data::is_markups_file(path)) {
    if (vascular::has_mesh_ending(path)) return read_mesh(path, unit, weld_m);
    throw vascular::MeshError(path + ": its ending names nothing that is read as a vessel; expected a mesh (" +
                              vascular::listed_mesh_endings() + ") or centrelines of 3D Slicer (.mrk.json)");
  }
  const std::vector<vascular::Tube> tubes = data::load_markups(path).tubes;
  vascular::ContourSettings settings;
  for (const vascular::Tube& tube : tubes)
    for (const vascular::TubeNode& node : tube.nodes)
      settings.finest_m = std::min(settings.finest_m, node.radius_m / 2.5);  // some 16 triangles around
  vascular::MeshFile file;
  file.mesh = contour(vascular::TubeUnion(tubes), settings).mesh;
  flatten_ends(tubes, file.mesh);
  for (Eigen::Vector3d& p : file.mesh.vertices) p *= metres(unit) / units::mm;
  return file;
}

}  // namespace ostium::app
