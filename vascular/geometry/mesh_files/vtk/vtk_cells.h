#pragma once
/// Cells of VTK: polygons, strips, lines and points become triangles.
#include <cstdint>
#include <string>
#include <vector>

#include "vascular/geometry/mesh_files/raw_surface.h"

namespace ostium::vascular {

/// VTK's numbers for those that PolyData has in groups of their own.
namespace vtk_cell {
constexpr std::int64_t vertices = 2, line = 4, strip = 6, polygon = 7;
}

struct VtkCells {
  std::string name;                        ///< of the group, for messages
  std::vector<std::int64_t> connectivity;  ///< the points of all cells, one cell after another
  std::vector<std::int64_t> ends;          ///< where in `connectivity` each cell ends
  std::vector<std::int64_t> types;         ///< VTK's number for each cell, or one for all of them
};

/// Points from coordinates; throws MeshError unless there are three for each of `count` points.
std::vector<Eigen::Vector3d> vtk_points(const std::string& path, const std::vector<double>& coordinates,
                                        std::uint64_t count);

/// Polygons and quads become fans, strips turn every second triangle, points and lines are counted as skipped. Throws
/// MeshError for cells with a volume or with curved edges, and for cells that name points which are not there.
void add_cells(const std::string& path, const std::vector<Eigen::Vector3d>& points, const VtkCells& cells,
               RawSurface& surface);

}  // namespace ostium::vascular
