#include "app/check_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "vascular/mesh.h"
#include "vascular/patient_frame.h"
#include "vascular/surface_check.h"

namespace ostium {

namespace {

nlohmann::ordered_json fault_json(const SurfaceFault& fault) {
  nlohmann::ordered_json where = nlohmann::ordered_json::array();
  for (const Eigen::Vector3d& p : fault.where) {
    const Eigen::Vector3d mm = mm_from_patient(p);
    where.push_back({mm.x(), mm.y(), mm.z()});
  }
  return {{"count", fault.count}, {"where_mm", where}};
}

nlohmann::ordered_json report_json(const std::string& file, const MeshFile& mesh, const SurfaceReport& r) {
  return {{"file", file},
          {"vertices", r.vertices},
          {"triangles", r.triangles},
          {"components", r.components},
          {"volume_mL", 1e6 * r.volume_m3},
          {"area_cm2", 1e4 * r.area_m2},
          {"welded_vertices", mesh.welded_vertices},
          {"dropped_triangles", mesh.dropped_triangles},
          {"open_edges", fault_json(r.open_edges)},
          {"branching_edges", fault_json(r.branching_edges)},
          {"flipped_edges", fault_json(r.flipped_edges)},
          {"pinched_vertices", fault_json(r.pinched_vertices)},
          {"slivers", fault_json(r.slivers)},
          {"inverted", fault_json(r.inverted)},
          {"crossings", fault_json(r.crossings)},
          {"sound", r.sound()}};
}

}  // namespace

int check_command(const CheckOptions& options) {
  const LengthUnit unit = options.unit == "m"    ? LengthUnit::metre
                          : options.unit == "cm" ? LengthUnit::centimetre
                                                 : LengthUnit::millimetre;
  bool sound = true;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& file : options.files) {
    const MeshFile mesh = read_mesh(file, unit);
    const SurfaceReport report = check_surface(mesh.mesh);
    sound = sound && report.sound();
    if (options.json) {
      all.push_back(report_json(file, mesh, report));
      continue;
    }
    fmt::print("{}: {} triangles, {} vertices, {} component{}, {:.2f} mL, {:.1f} cm2\n", file, report.triangles,
               report.vertices, report.components, report.components == 1 ? "" : "s", 1e6 * report.volume_m3,
               1e4 * report.area_m2);
    if (mesh.welded_vertices || mesh.dropped_triangles)
      fmt::print("mended: {} vertices welded, {} triangles without width dropped\n", mesh.welded_vertices,
                 mesh.dropped_triangles);
    fmt::print("{}", describe(report));
  }
  if (options.json) fmt::print("{}\n", all.dump(2));
  return sound ? 0 : 1;
}

}  // namespace ostium
