#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/progress.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/case/tree_file.h"
#include "data/formats/load_error.h"
#include "data/formats/mesh_writer.h"
#include "vascular/geometry/mesh/mesh.h"
#include "vascular/thorax/thorax.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string name;  ///< empty: all
  bool json = false;
  std::string folder;  ///< if not empty, the case's surfaces and centrelines are written there
};

void declare(Options& options, Arguments& a) {
  options.add("name", a.name, "One of them, with its card and its arteries").type("NAME");
  add_json_flag(options, a.json, "cases.schema.json");
  options.add("--export", a.folder, "Write the beating lumen (24 OBJ) and centrelines (JSON, VTP) there").type("DIR");
}

namespace fs = std::filesystem;

/// Writes 24 surfaces of the beat, the tree for each of them, and the other bodies an X-ray sees.
void write_case(const data::Case& c, const std::string& folder) {
  show_progress("building " + c.name);
  const vascular::Patient patient = patient_of(c);
  make_folder(folder);
  for (int f = 0; f < vascular::beat_frames; ++f) {
    show_progress(fmt::format("frame {} of {}", f + 1, vascular::beat_frames));
    const fs::path base = folder;
    data::write_mesh((base / fmt::format("lumen-{:02}.obj", f)).string(),
                     patient.lumen.at(static_cast<double>(f) / vascular::beat_frames, 0),
                     vascular::LengthUnit::millimetre);
    data::write_tree((base / fmt::format("tree-{:02}.json", f)).string(),
                     patient.tree_frames[static_cast<std::size_t>(f)]);
    data::write_tree((base / fmt::format("tree-{:02}.vtp", f)).string(),
                     patient.tree_frames[static_cast<std::size_t>(f)]);
  }
  const std::vector<vascular::XrayBody> bodies = make_thorax(patient.anatomy);
  for (const vascular::XrayBody& body : bodies) {
    std::string name = body.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    std::erase(name, ',');
    data::write_mesh((fs::path(folder) / ("body-" + name + ".obj")).string(), body.mesh,
                     vascular::LengthUnit::millimetre);
  }
  show_progress("");
  fmt::print("{}: {} triangles and {} spheres in each of {} frames, {} bodies\n", folder,
             patient.lumen.triangles.size(), patient.tree.spheres(), vascular::beat_frames, bodies.size());
}

int run(const Arguments& a) {
  std::vector<std::string> unread;
  const std::vector<data::Case> cases =
      a.name.empty() ? data::load_cases(&unread) : std::vector<data::Case>{data::find_case(a.name)};
  for (const std::string& why : unread) fmt::print(stderr, "left out: {}\n", why);
  if (!a.folder.empty()) {
    if (a.name.empty())
      throw data::LoadError("--export writes one case; name it, for example: ostium cases rca-mid-focal --export DIR");
    write_case(cases.front(), a.folder);
  } else if (a.json) {
    fmt::print("{}\n", to_json(cases));
  } else if (!a.name.empty()) {
    fmt::print("{}", case_details(cases.front()));
  } else {
    fmt::print("{}\n", data::case_heading());
    for (const data::Case& c : cases) fmt::print("{}\n", case_line(c));
  }
  return 0;
}

}  // namespace

Command cases_command() {
  return make_command("cases", "What cases there are to rehearse",
                      {"ostium cases", "ostium cases rca-mid-focal", "ostium cases rca-mid-focal --export out/rca"},
                      declare, run);
}

}  // namespace ostium::app
