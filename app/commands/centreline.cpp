#include "vascular/geometry/centreline/centreline.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/mesh_unit.h"
#include "app/command_line/progress.h"
#include "app/command_line/read_vessel.h"
#include "app/commands/import/file_axes.h"
#include "data/catalogue/case/tree_file.h"
#include "vascular/anatomy/lumen/lumen_parts.h"
#include "vascular/geometry/centreline/reach.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh_files/open_end.h"
#include "vascular/geometry/repair/double_wall.h"
#include "vascular/geometry/repair/repair.h"
#include "vascular/geometry/repair/sheets.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string mesh;
  std::string unit = "auto";      ///< auto, mm, cm, m or in
  std::string start;              ///< "x,y,z" in the file's unit; empty: the widest end
  std::vector<std::string> ends;  ///< the same; empty: all prominent ends
  std::string output;             ///< .json or .vtp
};

void declare(Options& options, Arguments& a) {
  options.add("mesh", a.mesh, "STL, PLY, OBJ, VTP, ...").type("MESH").required();
  add_unit_option(options, a.unit, "What a number in the file means");
  options.add("--start", a.start, "Where to begin; else at the widest end").type("X,Y,Z");
  options.add("--end", a.ends, "Where branches end; else all that stand out").type("X,Y,Z");
  options.add("-o,--output", a.output, "In the mesh's axes: .json, in mm, or .vtp, in the mesh's unit")
      .type("FILE.json|FILE.vtp")
      .required()
      .writes();
}

/// Between ends that somebody chose a line may be short.
void require_long(const vascular::SphereTree& tree) {
  double longest = 0, widest = 0;
  for (const vascular::Course& course : courses_of(tree)) longest = std::max(longest, course.length_m());
  for (const vascular::TreeBranch& branch : tree.branches)
    for (const vascular::TreeSphere& sphere : branch.spheres) widest = std::max(widest, 2 * sphere.radius_m);
  vascular::require_vessel(longest, widest);
}

/// The piece that holds the start or is nearest to it; without one, the largest.
vascular::Mesh piece_of(const vascular::Mesh& mesh, const vascular::CentrelineOptions& wanted) {
  std::vector<vascular::Mesh> pieces = vascular::components_of(mesh);
  const auto rank = [&](const vascular::Mesh& piece) {
    if (!wanted.start) return volume_m3(piece);
    if (winding_number(piece, *wanted.start) > 0.5) return 0.0;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : piece.vertices) nearest_m = std::min(nearest_m, (p - *wanted.start).norm());
    return -nearest_m;
  };
  return *std::max_element(pieces.begin(), pieces.end(),
                           [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

int run(const Arguments& a) {
  const bool in_json = data::writes_tree_as_json(a.output);
  const MeshUnit found_unit = unit_of({a.mesh}, read_vessel(a.mesh, vascular::LengthUnit::metre, 0).mesh, a.unit);
  if (!found_unit.known()) fmt::print(stderr, "{}: units: {}\n", a.mesh, describe(found_unit));
  if (const std::string doubt = vascular::doubt_of_mesh_end(a.mesh); !doubt.empty())
    fmt::print(stderr, "ostium centreline: {}\n", doubt);
  const vascular::LengthUnit unit = found_unit.unit;
  vascular::CentrelineOptions wanted;
  if (!a.start.empty()) mesh_point(a.start);
  for (const std::string& end : a.ends) mesh_point(end);
  vascular::Mesh mesh = read_vessel(a.mesh, unit, found_unit.known() ? vascular::default_weld_m : 0).mesh;
  if (!a.start.empty()) wanted.start = point_of(mesh, unit, a.start);
  for (const std::string& end : a.ends) wanted.ends.push_back(point_of(mesh, unit, end));
  vascular::SurfaceReport report = check_surface(mesh);
  report.open_edges = {};  // get lids
  if (!report.sound()) fmt::print(stderr, "{}: not sound, so parts may be missing:\n{}", a.mesh, describe(report));
  show_progress("looking for centrelines");
  const std::vector<vascular::Opening> openings = close_all(mesh);
  if (find_double_wall(mesh, sheets_of(mesh)).triangles)
    throw vascular::MeshError(a.mesh +
                              ": has a double wall; expected the lumen, which `ostium import` takes out of it");
  // Pieces that do not cross are vessels of their own, however near to one another.
  const bool apart = report.components > 1 && report.crossings.count == 0;
  const vascular::CentrelineResult found = find_centrelines(apart ? piece_of(mesh, wanted) : mesh, wanted);
  if (wanted.ends.empty()) require_long(found.tree);
  if (found.tree.spheres() < 2)
    throw vascular::MeshError(a.mesh + ": --start and --end are one point of the vessel; expected points apart");
  if (report.components > 1 && !apart)
    fmt::print(stderr, "{}: {} pieces, of which those that cross are taken for one\n", a.mesh, report.components);
  if (apart)
    fmt::print(
        stderr,
        "{}: {} separate pieces; the lines are of what hangs together with their beginning, --start X,Y,Z chooses "
        "another\n",
        a.mesh, report.components);
  if (const vascular::Unreached rest = unreached(mesh, found.tree);
      report.components == 1 && wanted.ends.empty() && rest.share > vascular::unreached_matters) {
    const Eigen::Vector3d p = rest.p / metres(unit);
    fmt::print(stderr, "{}: {:.0f} % of the wall has no line: it hangs on too finely, near {:.2f} {:.2f} {:.2f} {}\n",
               a.mesh, 100 * rest.share, p.x(), p.y(), p.z(), name_of(unit));
  }
  data::write_tree(a.output, found.tree, unit);
  show_progress("");
  for (const vascular::Opening& opening : openings) {
    const Eigen::Vector3d p = opening.middle / metres(unit);
    fmt::print("open, so it got a lid: at {:.2f} {:.2f} {:.2f} {}\n", p.x(), p.y(), p.z(), name_of(unit));
  }
  for (const Eigen::Vector3d& cut : found.cuts) {
    const Eigen::Vector3d p = cut / metres(unit);
    fmt::print("a loop was cut open: at {:.2f} {:.2f} {:.2f} {}\n", p.x(), p.y(), p.z(), name_of(unit));
  }
  const std::string axes = axes_said_by(a.mesh);
  fmt::print("{}: {} branches, {} spheres, in the mesh's axes{} and in {}; looked at {:.2f} mm\n", a.output,
             found.tree.branches.size(), found.tree.spheres(), axes.empty() ? "" : ", " + axes + ",",
             in_json ? "mm" : name_of(unit), 1e3 * found.voxel_m);
  for (const vascular::TreeBranch& branch : found.tree.branches)
    fmt::print("  {:>3} from {:>3}  {:7.1f} mm, radius {:.2f} to {:.2f} mm\n", branch.name,
               branch.parent < 0 ? "-" : found.tree.branches[static_cast<std::size_t>(branch.parent)].name,
               1e3 * branch.spheres.back().s_m, 1e3 * branch.spheres.front().radius_m,
               1e3 * branch.spheres.back().radius_m);
  return 0;
}

}  // namespace

Command centreline_command() {
  return make_command("centreline", "The centreline-sphere tree of a mesh, closed where it is open",
                      {"ostium centreline coronaries.stl -o tree.json",
                       "ostium centreline aorta.obj --start 0,120,-30 --end 5,-200,-40 --end -60,-380,10 -o tree.vtp"},
                      declare, run);
}

}  // namespace ostium::app
