#include "app/cases_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "data/catalogue/case/case.h"
#include "data/formats/load_error.h"
#include "data/catalogue/case/tree_file.h"
#include "vascular/mesh.h"
#include "vascular/thorax/thorax.h"

namespace ostium {

namespace {

namespace fs = std::filesystem;

void say(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{:<78}\r", what);
}

/// 24 surfaces of the beat, the tree in each of them, and what else an X-ray meets.
void write_case(const Case& c, const std::string& folder) {
  say("building " + c.name);
  const Patient patient = patient_of(c);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw LoadError(fmt::format("{}: cannot be made ({}); expected a folder", folder, error.message()));
  for (int f = 0; f < beat_frames; ++f) {
    say(fmt::format("frame {} of {}", f + 1, beat_frames));
    const fs::path base = folder;
    write_mesh((base / fmt::format("lumen-{:02}.obj", f)).string(),
               patient.lumen.at(static_cast<double>(f) / beat_frames, 0), LengthUnit::millimetre);
    write_tree((base / fmt::format("tree-{:02}.json", f)).string(), patient.tree_frames[static_cast<std::size_t>(f)]);
    write_tree((base / fmt::format("tree-{:02}.vtp", f)).string(), patient.tree_frames[static_cast<std::size_t>(f)]);
  }
  const std::vector<XrayBody> bodies = make_thorax(patient.anatomy);
  for (const XrayBody& body : bodies) {
    std::string name = body.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    std::erase(name, ',');
    write_mesh((fs::path(folder) / ("body-" + name + ".obj")).string(), body.mesh, LengthUnit::millimetre);
  }
  say("");
  fmt::print("{}: {} triangles and {} spheres in each of {} frames, {} bodies\n", folder,
             patient.lumen.triangles.size(), patient.tree.spheres(), beat_frames, bodies.size());
}

}  // namespace

int cases_command(const CasesOptions& options) {
  const std::vector<Case> cases = options.name.empty() ? load_cases() : std::vector<Case>{find_case(options.name)};
  if (!options.folder.empty()) {
    if (options.name.empty())
      throw LoadError("--export writes one case; name it, for example: ostium cases rca-mid-focal --export DIR");
    write_case(cases.front(), options.folder);
  } else if (options.json) {
    fmt::print("{}\n", to_json(cases));
  } else if (!options.name.empty()) {
    fmt::print("{}", case_details(cases.front()));
  } else {
    fmt::print("{}\n", case_heading());
    for (const Case& c : cases) fmt::print("{}\n", case_line(c));
  }
  return 0;
}

}  // namespace ostium
