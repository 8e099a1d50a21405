#include "app/centreline_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "data/formats/load_error.h"
#include "data/catalogue/case/tree_file.h"
#include "vascular/surface_check.h"
#include "vascular/tree/centreline.h"

namespace ostium {

namespace {

Eigen::Vector3d point(const std::string& text, LengthUnit unit) {
  double x, y, z;
  char rest;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &x, &y, &z, &rest) != 3)
    throw LoadError(
        fmt::format("the point \"{}\" is not x,y,z; expected three numbers with commas, in the mesh's unit", text));
  return metres(unit) * Eigen::Vector3d(x, y, z);
}

}  // namespace

int centreline_command(const CentrelineCommandOptions& options) {
  const LengthUnit unit = options.unit == "m"    ? LengthUnit::metre
                          : options.unit == "cm" ? LengthUnit::centimetre
                                                 : LengthUnit::millimetre;
  CentrelineOptions wanted;
  if (!options.start.empty()) wanted.start = point(options.start, unit);
  for (const std::string& end : options.ends) wanted.ends.push_back(point(end, unit));
  const Mesh mesh = read_mesh(options.mesh, unit).mesh;
  if (const SurfaceReport report = check_surface(mesh); !report.sound())
    fmt::print(stderr, "{}: not sound, so parts may be missing:\n{}", options.mesh, describe(report));
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "looking for centrelines\r");
  const CentrelineResult found = find_centrelines(mesh, wanted);
  write_tree(options.output, found.tree);
  fmt::print("{}: {} branches, {} spheres; looked at {:.2f} mm\n", options.output, found.tree.branches.size(),
             found.tree.spheres(), 1e3 * found.voxel_m);
  for (const TreeBranch& branch : found.tree.branches)
    fmt::print("  {:>3} from {:>3}  {:7.1f} mm, radius {:.2f} to {:.2f} mm\n", branch.name,
               branch.parent < 0 ? "-" : found.tree.branches[static_cast<std::size_t>(branch.parent)].name,
               1e3 * branch.spheres.back().s_m, 1e3 * branch.spheres.front().radius_m,
               1e3 * branch.spheres.back().radius_m);
  return 0;
}

}  // namespace ostium
