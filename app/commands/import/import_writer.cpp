#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands/import/imported.h"
#include "core/base/units.h"
#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/case/tree_file.h"
#include "data/formats/load_error.h"
#include "data/formats/mesh_writer.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh_files/written_mesh.h"

namespace ostium::app {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using units::mm;

namespace {

std::string frame_name(std::size_t f) { return f ? fmt::format("lumen-{:02}.ply", f) : "lumen.ply"; }

Json imported_json(const Imported& x) {
  Json out = {{"anatomy", "anatomy.json"}, {"lumen", frame_name(0)}};
  for (std::size_t f = 1; f < x.frames.size(); ++f) out["frames"].push_back(frame_name(f));
  return out;
}

std::string case_json(const Imported& x) {
  Json lesions = Json::array();
  for (const vascular::Lesion& l : x.the_case.lesions)
    lesions.push_back({{"branch", l.branch},
                       {"from_mm", l.from_m / mm},
                       {"length_mm", l.length_m / mm},
                       {"stenosis_percent", 100 * l.stenosis},
                       {"shape", "concentric"},
                       {"calcified", false}});
  const Json json = {{"schema", "ostium-case/1"},
                     {"name", x.the_case.name},
                     {"title", x.the_case.title},
                     {"card",
                      {{"history", x.the_case.card.history},
                       {"ecg", x.the_case.card.ecg},
                       {"planned_access", x.the_case.card.planned_access}}},
                     {"imported", imported_json(x)},
                     {"heart_rate_1_min", x.the_case.rate_1_min},
                     {"lesions", lesions}};
  return json.dump(2) + "\n";
}

}  // namespace

void write_case(const Imported& x, const Json& report, const std::string& picture) {
  std::error_code error;
  if (x.folder.has_parent_path()) fs::create_directories(x.folder.parent_path(), error);
  const fs::path unfinished = x.folder.string() + ".unfinished";
  fs::remove_all(unfinished, error);
  fs::create_directory(unfinished, error);
  if (error)
    throw data::WriteError(
        fmt::format("{}: cannot be made ({}); expected a folder", unfinished.string(), error.message()));
  try {
    data::write_file((unfinished / (x.the_case.name + ".json")).string(), case_json(x));
    data::write_file((unfinished / "anatomy.json").string(), data::anatomy_to_json(x.found.anatomy));
    data::write_file((unfinished / "import.json").string(), report.dump(2) + "\n");
    data::write_mesh((unfinished / frame_name(0)).string(), x.found.lumen, vascular::LengthUnit::millimetre);
    for (std::size_t f = 1; f < x.frames.size(); ++f)
      data::write_mesh((unfinished / frame_name(f)).string(), x.frames[f], vascular::LengthUnit::millimetre);
    data::write_tree((unfinished / "tree.json").string(), x.patient.tree);
    data::write_tree((unfinished / "tree.vtp").string(), x.patient.tree);
    if (!picture.empty()) draw(x, picture);
  } catch (...) {
    fs::remove_all(unfinished, error);
    throw;
  }
  fs::remove_all(x.folder, error);
  fs::rename(unfinished, x.folder, error);
  if (error) {
    const std::string why = error.message();
    fs::remove_all(unfinished, error);
    throw data::write_error(x.folder.string(), why);
  }
}

}  // namespace ostium::app
