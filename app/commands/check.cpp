#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/mesh_unit.h"
#include "app/command_line/progress.h"
#include "app/command_line/read_vessel.h"
#include "data/catalogue/case/mesh_picture.h"
#include "data/formats/load_error.h"
#include "vascular/anatomy/lumen/lumen_parts.h"
#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh/patient_frame.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh_files/open_end.h"
#include "vascular/geometry/mesh_files/rounding.h"
#include "vascular/geometry/remesh/smooth.h"
#include "vascular/geometry/repair/calibre.h"
#include "vascular/geometry/repair/double_wall.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::vector<std::string> files;
  std::string unit = "auto";  ///< auto, mm, cm, m or in
  bool json = false;
  std::string picture;  ///< .png or .svg; empty: none
};

void declare(Options& options, Arguments& a) {
  options.add("mesh", a.files, "STL, PLY, OBJ, VTP, ...").type("MESH").required();
  add_unit_option(options, a.unit, "What a number in the file means");
  add_json_flag(options, a.json);
  options.add("--picture", a.picture, "The mesh with its faults (one file only)").type("FILE.png|FILE.svg").writes();
}

nlohmann::ordered_json fault_json(const vascular::SurfaceFault& fault) {
  nlohmann::ordered_json where = nlohmann::ordered_json::array();
  for (const Eigen::Vector3d& p : fault.where) {
    const Eigen::Vector3d mm = vascular::mm_from_patient(p);
    where.push_back({mm.x(), mm.y(), mm.z()});
  }
  return {{"count", fault.count}, {"where_mm", where}};
}

/// All findings about one file.
struct Checked {
  std::string file;
  vascular::MeshFile mesh;
  MeshUnit unit;
  vascular::SurfaceReport report;
  std::vector<vascular::Opening> ends, holes, pinholes;
  vascular::DoubleWall wall;
  std::size_t flipped = 0, inverted = 0;
  vascular::Roughness rough;
  double rounding_m = 0;          ///< between neighbouring numbers of the file
  std::vector<double> diameters;  ///< below which 2, 25, 50, 75, 98 % of the wall's area lies, m
  std::string no_vessel;          ///< why a surface without fault is none
};

constexpr double shares[] = {0.02, 0.25, 0.5, 0.75, 0.98};

/// Nothing is welded before the unit is known.
void read(const Arguments& a, Checked& c) {
  const vascular::Mesh raw = read_vessel(c.file, vascular::LengthUnit::metre, 0).mesh;
  c.unit = unit_of({c.file}, raw, a.unit);
  c.rounding_m = metres(c.unit.unit) * rounding_step(raw);
  c.mesh = read_vessel(c.file, c.unit.unit, c.unit.known() ? vascular::default_weld_m : 0);
  if (const std::string doubt = vascular::doubt_of_mesh_end(c.file); !doubt.empty())
    fmt::print(stderr, "ostium check: {}\n", doubt);
}

void find_openings(const vascular::Mesh& turned, const vascular::Sheets& sheets, Checked& c) {
  for (const vascular::Opening& opening : openings_of(turned, sheets))
    (opening.end ? c.ends : opening.pinhole() ? c.pinholes : c.holes).push_back(opening);
}

void measure_diameters(const vascular::Mesh& mesh, Checked& c) {
  const vascular::BoundingVolumeHierarchy tree(mesh);
  const int stride = 1 + static_cast<int>(mesh.triangles.size() / 20'000);
  const std::vector<double> all = calibres(mesh, tree, stride, c.unit.extent_m), areas = areas_m2(mesh, stride);
  for (double share : shares) c.diameters.push_back(vascular::percentile(all, areas, share));
}

/// As `import` asks it.
void find_vessel(Checked& c) {
  try {
    lumen_parts(c.mesh.mesh, [](const std::string&) {});
  } catch (const vascular::MeshError& error) {
    c.no_vessel = error.what();
  }
}

Checked look_at(const std::string& file, const Arguments& a) {
  Checked c;
  c.file = file;
  const TimedProgress progress(file + ": ", 1);
  progress("reading");
  read(a, c);
  progress("looking for faults");
  c.report = check_surface(c.mesh.mesh);
  if (c.report.triangles == 0)
    throw vascular::MeshError(file +
                              ": no triangle in it has a width; expected the surface of a vessel, export it again");
  vascular::Mesh turned = c.mesh.mesh;
  vascular::Sheets sheets = sheets_of(turned);
  const vascular::Orientation orientation = orient(turned, sheets);
  c.flipped = orientation.flipped.size();
  c.inverted = orientation.inverted.size();
  find_openings(turned, sheets, c);
  progress("looking for double walls");
  c.wall = find_double_wall(turned, sheets);
  c.rough = roughness(turned);
  // Of a thick wall the lumen inside it counts.
  measure_diameters(c.wall.triangles ? without_outer_wall(turned) : turned, c);
  if (c.report.sound() && !c.wall.triangles) {
    progress("looking for a vessel");
    find_vessel(c);
  }
  show_progress("");
  return c;
}

bool sound(const Checked& c) { return c.report.sound() && !c.wall.triangles && c.no_vessel.empty(); }

nlohmann::ordered_json openings_json(const std::vector<vascular::Opening>& openings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const vascular::Opening& o : openings) {
    const Eigen::Vector3d p = vascular::mm_from_patient(o.middle);
    list.push_back(
        {{"edges", o.half_edges.size()}, {"diameter_mm", 1e3 * o.diameter_m}, {"where_mm", {p.x(), p.y(), p.z()}}});
  }
  return list;
}

nlohmann::ordered_json report_json(const Checked& c) {
  const vascular::SurfaceReport& r = c.report;
  return {{"file", c.file},
          {"unit", name_of(c.unit.unit)},
          {"unit_from", name_of(c.unit.source)},
          {"extent_mm", 1e3 * c.unit.extent_m},
          {"vertices", r.vertices},
          {"triangles", r.triangles},
          {"components", r.components},
          {"volume_mL", 1e6 * r.volume_m3},
          {"area_cm2", 1e4 * r.area_m2},
          {"rounding_mm", 1e3 * c.rounding_m},
          {"welded_vertices", c.mesh.welded_vertices},
          {"dropped_triangles", c.mesh.dropped_triangles},
          {"skipped_faces", c.mesh.skipped_faces},
          {"open_ends", openings_json(c.ends)},
          {"holes", openings_json(c.holes)},
          {"pinholes", openings_json(c.pinholes)},
          {"open_edges", fault_json(r.open_edges)},
          {"branching_edges", fault_json(r.branching_edges)},
          {"flipped_edges", fault_json(r.flipped_edges)},
          {"flipped_triangles", c.flipped},
          {"inverted_pieces", c.inverted},
          {"pinched_vertices", fault_json(r.pinched_vertices)},
          {"slivers", fault_json(r.slivers)},
          {"inverted", fault_json(r.inverted)},
          {"crossings", fault_json(r.crossings)},
          {"double_wall", {{"triangles", c.wall.triangles}, {"thickness_mm", 1e3 * c.wall.thickness_m}}},
          {"roughness_mm", 1e3 * c.rough.height_m},
          {"diameter_mm",
           {{"2 %", 1e3 * c.diameters[0]},
            {"25 %", 1e3 * c.diameters[1]},
            {"50 %", 1e3 * c.diameters[2]},
            {"75 %", 1e3 * c.diameters[3]},
            {"98 %", 1e3 * c.diameters[4]}}},
          {"no_vessel", c.no_vessel.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(c.no_vessel)},
          {"sound", sound(c)}};
}

void print_openings(const char* what, const std::vector<vascular::Opening>& openings) {
  for (std::size_t i = 0; i < openings.size() && i < vascular::SurfaceFault::places_kept; ++i) {
    const Eigen::Vector3d p = vascular::mm_from_patient(openings[i].middle);
    fmt::print("{}: {} edges, {:.2f} mm wide, at {:.2f} {:.2f} {:.2f} mm\n", what, openings[i].half_edges.size(),
               1e3 * openings[i].diameter_m, p.x(), p.y(), p.z());
  }
  if (openings.size() > vascular::SurfaceFault::places_kept)
    fmt::print("... and {} more such\n", openings.size() - vascular::SurfaceFault::places_kept);
}

void print_size(const Checked& c) {
  const vascular::SurfaceReport& r = c.report;
  fmt::print("{}: {} triangles, {} vertices, {} component{}, {:.2f} mL, {:.1f} cm2\n", c.file, r.triangles, r.vertices,
             r.components, r.components == 1 ? "" : "s", 1e6 * r.volume_m3, 1e4 * r.area_m2);
  fmt::print("units: {}; spans {:.1f} mm{}\n", describe(c.unit), 1e3 * c.unit.extent_m,
             c.unit.vessel.empty() ? "" : ", the size of " + c.unit.vessel);
  fmt::print("vessels: {:.2f} mm wide at most of the wall (2 % below {:.2f}, 98 % below {:.2f})\n",
             1e3 * c.diameters[2], 1e3 * c.diameters[0], 1e3 * c.diameters[4]);
}

void print_rounding(const Checked& c) {
  if (c.diameters[2] > 0 && c.rounding_m > vascular::rounding_matters * c.diameters[2])
    fmt::print(
        "rounded: the file's numbers are {:.2g} mm apart, {:.0f} % of the vessels' width, and hide what is finer; save "
        "it with more digits, or moved to its origin\n",
        1e3 * c.rounding_m, 100 * c.rounding_m / c.diameters[2]);
}

void print_faults(const Checked& c) {
  if (c.mesh.welded_vertices || c.mesh.dropped_triangles || c.mesh.skipped_faces)
    fmt::print("mended: {} vertices welded, {} triangles without width dropped, {} points and lines left out\n",
               c.mesh.welded_vertices, c.mesh.dropped_triangles, c.mesh.skipped_faces);
  print_openings("open end", c.ends);
  print_openings("hole", c.holes);
  print_openings("pinhole", c.pinholes);
  if (c.flipped) fmt::print("{} triangles face another way than most of their piece\n", c.flipped);
  if (c.inverted) fmt::print("{} piece{} inwards\n", c.inverted, c.inverted == 1 ? " faces" : "s face");
  if (c.wall.triangles) {
    const Eigen::Vector3d p = vascular::mm_from_patient(c.wall.where);
    fmt::print(
        "double wall: {} triangles are of an outer one, {:.2f} mm outside, the first at {:.2f} {:.2f} {:.2f} mm; "
        "import keeps the lumen inside the inner one\n",
        c.wall.triangles, 1e3 * c.wall.thickness_m, p.x(), p.y(), p.z());
  }
  if (c.rough.noisy(c.diameters[2] / 2)) fmt::print("rough: vertices stand out by {:.2f} mm\n", 1e3 * c.rough.height_m);
  if (!c.no_vessel.empty())
    fmt::print("the surface has no fault, but {}\n", c.no_vessel);
  else if (!c.report.sound() || !c.wall.triangles)
    fmt::print("{}", describe(c.report));
}

void draw(const Checked& c, const std::string& picture) {
  std::vector<Eigen::Vector3d> rgb(c.mesh.mesh.vertices.size(), Eigen::Vector3d(205, 200, 192));
  for (std::size_t t = 0; t < c.wall.outer.size(); ++t)
    if (c.wall.outer[t])
      for (int v : c.mesh.mesh.triangles[t]) rgb[static_cast<std::size_t>(v)] = {225, 196, 120};
  std::vector<data::PictureMark> marks;
  const auto openings = [&](const std::vector<vascular::Opening>& all, const char* what,
                            const Eigen::Vector3d& colour) {
    for (const vascular::Opening& o : all)
      marks.push_back({o.middle, fmt::format("{} {:.1f} mm", what, 1e3 * o.diameter_m), colour});
  };
  openings(c.ends, "end", {20, 110, 200});
  openings(c.holes, "hole", {210, 100, 20});
  openings(c.pinholes, "pinhole", {210, 30, 30});
  for (const Eigen::Vector3d& p : c.report.crossings.where) marks.push_back({p, "", {170, 40, 170}});
  for (const Eigen::Vector3d& p : c.report.branching_edges.where) marks.push_back({p, "branching", {30, 140, 60}});
  draw_mesh(
      picture, c.mesh.mesh, rgb, marks,
      c.file.substr(c.file.rfind('/') + 1) +
          ": blue open ends, orange holes, red pinholes, violet crossings, green branching edges, yellow outer wall");
}

/// 0 if all meshes are sound, 1 if not.
int run(const Arguments& a) {
  if (!a.picture.empty() && a.files.size() != 1) throw data::LoadError("--picture draws one mesh; name one file");
  bool all_sound = true;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& file : a.files) {
    const Checked checked = look_at(file, a);
    all_sound = all_sound && sound(checked);
    if (a.json)
      all.push_back(report_json(checked));
    else
      print_size(checked), print_rounding(checked), print_faults(checked);
    if (!a.picture.empty()) draw(checked, a.picture);
  }
  if (a.json) fmt::print("{}\n", all.dump(2));
  return all_sound ? 0 : 1;
}

}  // namespace

Command check_command() {
  return make_command("check", "What is wrong with a mesh: holes, folds, crossings, and where",
                      {"ostium check aorta.stl --picture faults.svg", "ostium check --units m --json lumen.obj"},
                      declare, run);
}

}  // namespace ostium::app
