#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands/import/imported.h"
#include "core/base/units.h"
#include "vascular/geometry/mesh/surface_check.h"

namespace ostium::app {

using Json = nlohmann::ordered_json;
using units::mm;

namespace {

Json places(const std::vector<Eigen::Vector3d>& where) {
  Json list = Json::array();
  for (const Eigen::Vector3d& p : where) list.push_back({p.x() / mm, p.y() / mm, p.z() / mm});
  return list;
}

/// Null if there is no candidate, or one that can never be recognised.
Json doubt(double doubt) { return doubt > 0 && std::isfinite(doubt) ? Json(doubt) : Json(); }

/// A diameter inside of the end, where no lid or carina is nearer than the wall.
double end_calibre_m(const vascular::Anatomy& anatomy, const vascular::NamedBranch& branch, bool proximal) {
  const vascular::Tube& tube = anatomy.tubes[static_cast<std::size_t>(branch.tube)];
  const double end_m = proximal ? branch.from_m : branch.to_m;
  const double inside_m = std::min(2 * tube.at(end_m).radius_m, branch.length_m() / 2);
  return 2 * tube.at(end_m + (proximal ? inside_m : -inside_m)).radius_m;
}

}  // namespace

Json report_of(const Imported& x) {
  Json mends = Json::array(), branches = Json::array(), narrow = Json::array();
  for (const vascular::RepairNote& note : x.repaired.notes)
    mends.push_back({{"what", note.what}, {"count", note.count}, {"where_mm", places(note.where)}});
  const vascular::Anatomy& a = x.found.anatomy;
  for (const vascular::NamedBranch& b : a.branches)
    branches.push_back({{"name", b.name},
                        {"length_mm", b.length_m() / mm},
                        {"proximal_mm", end_calibre_m(a, b, true) / mm},
                        {"distal_mm", end_calibre_m(a, b, false) / mm}});
  for (const vascular::FoundNarrowing& n : x.narrowings)
    narrow.push_back({{"branch", n.branch},
                      {"at_mm", n.at_m / mm},
                      {"from_mm", n.from_m / mm},
                      {"length_mm", (n.to_m - n.from_m) / mm},
                      {"stenosis_percent", 100 * n.stenosis}});
  const Eigen::Matrix3d& R = x.found.R_PF;
  return {{"case", x.the_case.name},
          {"files", x.files},
          {"triangles_in", x.triangles},
          {"unit", name_of(x.unit.unit)},
          {"unit_from", name_of(x.unit.source)},
          {"extent_mm", x.unit.extent_m / mm},
          {"lumens", x.repaired.lumens},
          {"triangles", x.found.lumen.triangles.size()},
          {"volume_mL", 1e6 * volume_m3(x.found.lumen)},
          {"sound", check_surface(x.found.lumen).sound()},
          {"beats", x.patient.lumen.moving > 0},
          {"voxel_mm", x.repaired.voxel_m / mm},
          {"mends", mends},
          {"aorta_rms_mm", x.found.aorta_rms_m / mm},
          {"heart_rms_mm", x.found.heart_rms_m / mm},
          {"aorta_doubt", doubt(x.found.aorta_doubt)},
          {"heart_doubt", doubt(x.found.heart_doubt)},
          {"axes_from", x.axes.said_by_file                                  ? "file"
                        : !x.axes.letters.empty()                            ? "option"
                        : x.found.aorta_rms_m > 0 || x.found.heart_rms_m > 0 ? "anatomy"
                                                                             : "none"},
          {"axes", {{R(0, 0), R(0, 1), R(0, 2)}, {R(1, 0), R(1, 1), R(1, 2)}, {R(2, 0), R(2, 1), R(2, 2)}}},
          {"origin_mm", {x.found.shift_P.x() / mm, x.found.shift_P.y() / mm, x.found.shift_P.z() / mm}},
          {"branches", branches},
          {"narrowings", narrow},
          {"notes", x.found.notes}};
}

void tell(const Imported& x, const std::string& called) {
  fmt::print("{}: {} triangles, {} closed lumen{}, {:.1f} mL, {}\n", x.folder.string(), x.found.lumen.triangles.size(),
             x.repaired.lumens, x.repaired.lumens == 1 ? "" : "s", 1e6 * volume_m3(x.found.lumen),
             !x.frames.empty()            ? fmt::format("beating in {} frames", x.frames.size())
             : x.found.heart              ? "beating"
             : x.patient.lumen.moving > 0 ? "beating at the root of the aorta"
                                          : "still");
  fmt::print("units: {}; spans {:.0f} mm, {:.1f} mm wide\n", describe(x.unit), x.unit.extent_m / mm,
             x.unit.calibre_m / mm);
  if (x.axes.said_by_file) fmt::print("axes: {}, as the file says\n", x.axes.letters);
  if (x.skipped) fmt::print("{} points or lines in the files were left out\n", x.skipped);
  for (const vascular::RepairNote& note : x.repaired.notes) {
    fmt::print("mended: {} x {}", note.count, note.what);
    if (!note.where.empty()) {
      // A millionth of the size is rounding, and is written as 0.
      const Eigen::Vector3d p = (note.where.front().array().abs() < 1e-6 * x.unit.extent_m)
                                    .select(Eigen::Vector3d::Zero(), note.where.front() / metres(x.unit.unit));
      fmt::print(", the first at {:.4g} {:.4g} {:.4g}", p.x(), p.y(), p.z());
    }
    fmt::print("\n");
  }
  if (x.found.aorta_rms_m > 0)
    fmt::print("aorta: {:.1f} mm from the mean one's course (rms)\n", x.found.aorta_rms_m / mm);
  if (x.found.heart)
    fmt::print("coronary arteries: {:.1f} mm from the mean ones' courses (rms)\n", x.found.heart_rms_m / mm);
  if (!x.found.heart && x.found.heart_doubt > 0)
    fmt::print(
        "no coronary arteries were recognised; if they are some, let them be named and beat: --motion coronary\n");
  const vascular::Anatomy& a = x.found.anatomy;
  fmt::print("  {:<18} {:>9} {:>12} {:>10}\n", "branch", "length mm", "proximal mm", "distal mm");
  for (const vascular::NamedBranch& b : a.branches)
    fmt::print("  {:<18} {:9.1f} {:12.2f} {:10.2f}\n", b.name, b.length_m() / mm, end_calibre_m(a, b, true) / mm,
               end_calibre_m(a, b, false) / mm);
  for (const vascular::FoundNarrowing& n : x.narrowings)
    fmt::print(
        "narrowing kept: {} from {:.0f} mm, {:.0f} mm long, the diameter of {:.1f} mm less by {:.0f} % at {:.0f} mm\n",
        n.branch, n.from_m / mm, (n.to_m - n.from_m) / mm, n.reference_m / mm, 100 * n.stenosis, n.at_m / mm);
  for (const std::string& note : x.found.notes) fmt::print("note: {}\n", note);
  if (find_branch(x.found.anatomy, "aorta"))
    fmt::print("rehearse on it as on any case: ostium cases {}\n", called);
  else
    fmt::print(
        "scripts that ship begin in an aorta; rehearse on it with your own (data/scripts): ostium run {} --script "
        "FILE.json\n",
        called);
}

}  // namespace ostium::app
