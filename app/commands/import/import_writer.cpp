#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/command_line/path_lock.h"
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

/// Whether an import of this name writes it.
bool is_ours(const fs::path& file, const std::string& name) {
  const std::string is = file.filename().string();
  for (const std::string& own : {name + ".json", std::string("anatomy.json"), std::string("import.json"),
                                 std::string("tree.json"), std::string("tree.vtp"), frame_name(0)})
    if (is == own) return true;
  return is.starts_with("lumen-") && is.ends_with(".ply");
}

void empty(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) fs::remove_all(entry.path(), error);
}

}  // namespace

void require_new_or_case(const fs::path& folder, const std::string& name) {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(folder, none))) return;
  if (!fs::is_directory(folder, none))
    throw data::LoadError(folder.string() + ": is there and is no folder; expected a new one, or an imported case");
  bool empty = true, of_a_case = false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    empty = false;
    of_a_case |= entry.path().filename() == name + ".json";
  }
  if (!empty && !of_a_case)
    throw data::LoadError(folder.string() +
                          ": is there and holds no imported case; expected a new folder, or one to renew");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (!entry.is_regular_file(none) || !is_ours(entry.path(), name))
      throw data::LoadError(
          fmt::format("{}: holds {}, too, which would be lost as the case is renewed; move it, or name "
                      "another folder",
                      folder.string(), entry.path().filename().string()));
}

std::optional<fs::file_time_type> written_at(const fs::path& folder) {
  std::error_code none;
  const fs::file_time_type at = fs::last_write_time(folder, none);
  return none ? std::nullopt : std::optional(at);
}

void write_case(const Imported& x, const Json& report, const std::string& picture) {
  std::error_code error;
  if (x.folder.has_parent_path()) fs::create_directories(x.folder.parent_path(), error);
  const fs::path unfinished = x.folder.string() + ".unfinished";
  fs::create_directory(unfinished, error);
  if (error)
    throw data::WriteError(
        fmt::format("{}: cannot be made ({}); expected a folder", unfinished.string(), error.message()));
  const PathLock lock(unfinished.string());
  empty(unfinished);  // of an import that was killed
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
  try {
    require_new_or_case(x.folder, x.the_case.name);  // it took a while
    if (written_at(x.folder) != x.folder_written_at)
      throw data::LoadError(x.folder.string() +
                            ": somebody wrote there meanwhile, which is kept; call again, or name another folder");
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
