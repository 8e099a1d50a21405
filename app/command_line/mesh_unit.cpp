#include "app/command_line/mesh_unit.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <optional>

#include "app/command_line/arguments.h"
#include "data/catalogue/case/markups_file.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/mesh_files/unit_mark.h"
#include "vascular/geometry/repair/double_wall.h"

namespace ostium::app {

namespace {

constexpr double largest_m = 10;

std::optional<vascular::LengthUnit> marked_unit(const std::vector<std::string>& files) {
  std::optional<vascular::LengthUnit> found;
  std::string where;
  for (const std::string& file : files) {
    const auto unit = data::is_markups_file(file) ? vascular::LengthUnit::millimetre : vascular::unit_mark_of(file);
    if (!unit) continue;
    if (found && *found != *unit)
      throw vascular::MeshError(
          fmt::format("{}: says that its unit is {}, and {} says {}; expected files of one unit: convert one, or say "
                      "the unit of all with --units",
                      file, name_of(*unit), where, name_of(*found)));
    found = unit, where = file;
  }
  return found;
}

[[noreturn]] void ask(const std::string& file, const vascular::VesselSize& size,
                      const std::vector<vascular::UnitReading>& readings) {
  std::string list, names;
  for (const vascular::UnitReading& reading : readings) {
    const double mm = 1e3 * metres(reading.unit);
    list += fmt::format("\n  --units {:<2}  spans {:.4g} mm, vessels {:.3g} mm wide: {}", name_of(reading.unit),
                        mm * size.extent, mm * size.wide, reading.vessel);
    names += (names.empty() ? "" : " or ") + name_of(reading.unit);
  }
  throw vascular::MeshError(fmt::format("{}: its numbers may be {}; say which:{}", file, names, list));
}

}  // namespace

MeshUnit unit_of(const std::vector<std::string>& files, const vascular::Mesh& raw, const std::string& said) {
  // Of a thick wall the lumen inside it counts: as it is, its calibre would be the wall's thickness.
  const vascular::VesselSize size = vessel_size(without_outer_wall(raw));
  const std::vector<vascular::UnitReading> readings = unit_readings(size);
  MeshUnit unit;
  if (said != "auto") {
    unit.unit = vascular::unit_named(said), unit.source = MeshUnit::Source::option;
  } else if (const auto marked = marked_unit(files)) {
    unit.unit = *marked, unit.source = MeshUnit::Source::file;
  } else if (readings.size() == 1) {
    unit.unit = readings.front().unit, unit.source = MeshUnit::Source::size;
  } else if (readings.size() > 1) {
    ask(files.front(), size, readings);
  }
  for (const vascular::UnitReading& reading : readings)
    if (reading.unit == unit.unit) unit.vessel = reading.vessel;
  unit.extent_m = metres(unit.unit) * size.extent;
  unit.calibre_m = metres(unit.unit) * size.wide;
  if (unit.extent_m > largest_m)
    throw vascular::MeshError(
        fmt::format("{}: is {:.3g} m long if its numbers are {}; expected vessels, {:g} m long at most: {}",
                    files.front(), unit.extent_m, name_of(unit.unit), largest_m,
                    unit.unit == vascular::LengthUnit::millimetre
                        ? "is the file damaged? numbers in micrometres have to be divided by 1000"
                        : "say its unit with --units, or is the file damaged?"));
  return unit;
}

void require_known(const std::string& file, const MeshUnit& unit) {
  if (unit.known()) return;
  constexpr double mm = 1e-3;
  throw vascular::MeshError(fmt::format(
      "{}: no unit makes a vessel of this: as {} it spans {:.3g} mm, and is {:.3g} mm wide; if it is one, say "
      "its unit with --units",
      file, name_of(unit.unit), unit.extent_m / mm, unit.calibre_m / mm));
}

Eigen::Vector3d point_of(const vascular::Mesh& mesh, vascular::LengthUnit unit, const std::string& text) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  const double scale = metres(unit);
  Eigen::Vector3d point = scale * mesh_point(text);
  if (box.exteriorDistance(point) <= 0.1 * box.diagonal().norm()) return point;
  const Eigen::Vector3d least = box.min() / scale, most = box.max() / scale;
  throw data::LoadError(fmt::format(
      "the point {} lies far outside the mesh, which goes from {:.4g},{:.4g},{:.4g} to {:.4g},{:.4g},{:.4g} "
      "{}; expected a point of it, in its axes and its unit",
      text, least.x(), least.y(), least.z(), most.x(), most.y(), most.z(), name_of(unit)));
}

std::string describe(const MeshUnit& unit) {
  switch (unit.source) {
    case MeshUnit::Source::option:
      return name_of(unit.unit) + ", as you said";
    case MeshUnit::Source::file:
      return name_of(unit.unit) + ", as the file says";
    case MeshUnit::Source::size:
      return name_of(unit.unit) + ", since no other makes an artery of it";
    case MeshUnit::Source::none:
      break;
  }
  return "taken for " + name_of(unit.unit) + ", and none makes an artery of it: say it with --units";
}

std::string name_of(MeshUnit::Source source) {
  switch (source) {
    case MeshUnit::Source::option:
      return "option";
    case MeshUnit::Source::file:
      return "file";
    case MeshUnit::Source::size:
      return "size";
    case MeshUnit::Source::none:
      break;
  }
  return "none";
}

}  // namespace ostium::app
