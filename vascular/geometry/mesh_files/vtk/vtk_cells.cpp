#include "vascular/geometry/mesh_files/vtk/vtk_cells.h"

#include <fmt/format.h>

#include <limits>
#include <span>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh/polygon.h"

namespace ostium::vascular {

namespace {

using Points = std::span<const std::int64_t>;

enum class Kind { nothing, skipped, polygon, pixel, strip, volume, curved };

Kind kind_of(std::int64_t type) {
  switch (type) {
    case 0:
      return Kind::nothing;
    case 1:  // a point
    case vtk_cell::vertices:
    case 3:  // a line of two points
    case vtk_cell::line:
      return Kind::skipped;
    case 5:  // a triangle
    case vtk_cell::polygon:
    case 9:  // a quad
      return Kind::polygon;
    case vtk_cell::strip:
      return Kind::strip;
    case 8:  // a rectangle whose last two points are exchanged
      return Kind::pixel;
    default:
      break;
  }
  // From the tetrahedron to the hexagonal prism, the polyhedra, and the curved ones of the first two.
  const bool volume = (type >= 10 && type <= 16) || type == 41 || type == 42 || (type >= 24 && type <= 27) ||
                      type == 29 || type == 32 || type == 33 || type == 71 || type == 72;
  return volume ? Kind::volume : Kind::curved;
}

[[noreturn]] void refuse(const std::string& path, const VtkCells& cells, std::size_t cell, const std::string& why) {
  throw MeshError(fmt::format("{}: {}, cell {} of {} {}", path, cells.name, cell, cells.ends.size(), why));
}

/// Those of one cell, all of them there.
Points points_of(const std::string& path, const VtkCells& cells, std::size_t cell, std::size_t points) {
  const std::int64_t begin = cell ? cells.ends[cell - 1] : 0, end = cells.ends[cell];
  if (begin < 0 || end < begin || end > static_cast<std::int64_t>(cells.connectivity.size()))
    refuse(path, cells, cell,
           fmt::format("has the points {} to {} of {}; expected a whole file, copy or export it again", begin, end,
                       cells.connectivity.size()));
  const Points all =
      Points(cells.connectivity).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  for (std::int64_t p : all)
    if (p < 0 || p >= static_cast<std::int64_t>(points))
      refuse(path, cells, cell, fmt::format("names point {} of {}; expected a whole file, export it again", p, points));
  return all;
}

void add_triangle(const std::vector<Eigen::Vector3d>& points, std::int64_t a, std::int64_t b, std::int64_t c,
                  RawSurface& surface) {
  for (std::int64_t p : {a, b, c}) surface.corners.push_back(points[static_cast<std::size_t>(p)]);
}

}  // namespace

std::vector<Eigen::Vector3d> vtk_points(const std::string& path, const std::vector<double>& coordinates,
                                        std::uint64_t count) {
  if (coordinates.size() % 3 || coordinates.size() / 3 != count)
    throw MeshError(
        fmt::format("{}: promises {} points, and {} coordinates are there; expected three for each: copy or "
                    "export the file again",
                    path, count, coordinates.size()));
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  return points;
}

void add_cells(const std::string& path, const std::vector<Eigen::Vector3d>& points, const VtkCells& cells,
               RawSurface& surface) {
  for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) {
    const std::int64_t type = cells.types.size() == 1 ? cells.types.front() : cells.types[cell];
    const Kind kind = kind_of(type);
    if (kind == Kind::volume)
      refuse(path, cells, cell,
             "has a volume (a tetrahedron or the like); expected a surface: extract it first (VMTK: vmtkmeshtosurface; "
             "ParaView: Extract Surface; SimVascular writes it beside the mesh as .vtp)");
    if (kind == Kind::curved)
      refuse(path, cells, cell,
             fmt::format("is of VTK's type {}, which is curved or not known; expected triangles, quads, polygons or "
                         "strips: export the surface as triangles",
                         type));
    const Points p = points_of(path, cells, cell, points.size());
    if (kind == Kind::nothing) continue;
    if (kind == Kind::skipped || p.size() < 3) {
      if (surface.skipped < std::numeric_limits<int>::max()) ++surface.skipped;
    } else if (kind == Kind::pixel && p.size() == 4) {
      add_triangle(points, p[0], p[1], p[3], surface);
      add_triangle(points, p[0], p[3], p[2], surface);
    } else if (kind == Kind::strip) {
      for (std::size_t k = 2; k < p.size(); ++k)  // every second one runs the other way round
        add_triangle(points, p[k - 2 + k % 2], p[k - 1 - k % 2], p[k], surface);
    } else {
      std::vector<Eigen::Vector3d> corners;
      for (const std::int64_t i : p) corners.push_back(points[static_cast<std::size_t>(i)]);
      for (const auto& [a, b, c] : triangulated(corners)) add_triangle(points, p[a], p[b], p[c], surface);
    }
  }
}

}  // namespace ostium::vascular
