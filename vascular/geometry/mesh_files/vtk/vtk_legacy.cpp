#include "vascular/geometry/mesh_files/vtk/vtk_legacy.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/vtk/vtk_cells.h"
#include "vascular/geometry/mesh_files/vtk/vtk_legacy_text.h"

namespace ostium::vascular {

namespace {

class VtkLegacy {
 public:
  VtkLegacy(const std::string& path, const std::string& text) : in_(path, text) {}

  RawSurface read() {
    bool more = true;
    while (more) more = read_section(in_.word());
    if (dataset_.empty()) in_.refuse("names no DATASET; expected POLYDATA or UNSTRUCTURED_GRID");
    RawSurface surface;
    if (dataset_ == "unstructured_grid") {
      for (VtkCells& cells : groups_) {
        if (cells.ends.size() != types_.size())
          in_.refuse(fmt::format("has {} cells and {} CELL_TYPES; expected one for each: export it again",
                                 cells.ends.size(), types_.size()));
        cells.types = types_;
      }
    }
    for (const VtkCells& cells : groups_) add_cells(in_.path(), points_, cells, surface);
    return surface;
  }

 private:
  /// False at the end of what describes the surface.
  bool read_section(const std::string& name) {
    static const std::vector<std::pair<std::string, std::int64_t>> groups = {{"vertices", vtk_cell::vertices},
                                                                             {"lines", vtk_cell::line},
                                                                             {"polygons", vtk_cell::polygon},
                                                                             {"triangle_strips", vtk_cell::strip},
                                                                             {"cells", vtk_cell::polygon}};
    if (name.empty() || name == "point_data" || name == "cell_data") return false;
    if (name == "dataset")
      read_dataset();
    else if (name == "points")
      read_points();
    else if (name == "cell_types")
      types_ = in_.numbers<std::int64_t>(in_.count("CELL_TYPES"), VtkType::int32);
    else if (name == "field")
      in_.skip_field();
    else if (name == "metadata")
      in_.skip_metadata();
    else {
      for (const auto& [group, type] : groups)
        if (name == group && (name == "cells") == (dataset_ == "unstructured_grid")) {
          groups_.push_back(read_cells(name, type));
          return true;
        }
      in_.refuse(
          fmt::format("has \"{:.40}\" where POINTS, POLYGONS, CELLS or the like should stand; expected a whole "
                      "file, copy or export it again",
                      name));
    }
    return true;
  }

  void read_dataset() {
    dataset_ = in_.word();
    if (dataset_ != "polydata" && dataset_ != "unstructured_grid")
      in_.refuse(
          fmt::format("holds the dataset \"{:.40}\"; expected POLYDATA or UNSTRUCTURED_GRID: save the surface as "
                      ".vtp",
                      dataset_));
  }

  void read_points() {
    const std::uint64_t count = in_.count("POINTS");
    const VtkType type = in_.type();
    points_ = vtk_points(in_.path(), in_.numbers<double>(3 * count, type), count);
  }

  /// Before version 5 each cell has its number of points before them; since then there are two arrays, whose first
  /// offset is a zero.
  VtkCells read_cells(const std::string& name, std::int64_t type) {
    const std::uint64_t first = in_.count(name), second = in_.count(name);
    VtkCells cells{name, {}, {}, {type}};
    if (in_.version() >= 5) {
      if (first == 0) return cells;
      in_.expect("offsets");
      const VtkType offsets = in_.type();
      cells.ends = in_.numbers<std::int64_t>(first, offsets);
      if (cells.ends.front() != 0)
        in_.refuse(name + ": the first offset is not 0; expected a whole file, export again");
      cells.ends.erase(cells.ends.begin());
      in_.expect("connectivity");
      const VtkType connectivity = in_.type();
      cells.connectivity = in_.numbers<std::int64_t>(second, connectivity);
      return cells;
    }
    const std::vector<std::int64_t> all = in_.numbers<std::int64_t>(second, VtkType::int32);
    for (std::size_t at = 0; at < all.size();) {
      const std::int64_t points = all[at++];
      if (points < 0 || static_cast<std::uint64_t>(points) > all.size() - at)
        in_.refuse(
            fmt::format("{}: cell {} has {} points, and {} numbers are left; expected a whole file, export again", name,
                        cells.ends.size(), points, all.size() - at));
      for (std::int64_t k = 0; k < points; ++k) cells.connectivity.push_back(all[at++]);
      cells.ends.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
    }
    if (cells.ends.size() != first)
      in_.refuse(fmt::format("{}: promises {} cells, and {} are there; expected a whole file, copy or export it again",
                             name, first, cells.ends.size()));
    return cells;
  }

  VtkLegacyText in_;
  std::string dataset_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<VtkCells> groups_;
  std::vector<std::int64_t> types_;
};

}  // namespace

RawSurface read_vtk_legacy(const std::string& path, const std::string& text) { return VtkLegacy(path, text).read(); }

}  // namespace ostium::vascular
