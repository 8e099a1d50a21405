#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "core/base/units.h"
#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/case/case_keys.h"
#include "data/catalogue/case/markups_file.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "fluoro/projection/views.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/motion/tube_motion.h"

namespace ostium::data {

namespace {

namespace fs = std::filesystem;
CaseCard read_card(const JsonObject& card) {
  return {card.text("history"), card.text("ecg"), card.text("planned_access")};
}

void read_anatomy(const JsonObject& anatomy, Case& c) {
  const auto dominance = static_cast<vascular::Dominance>(anatomy.choice("dominance", {"right", "left", "balanced"}));
  const auto access = static_cast<vascular::Access>(anatomy.choice("access", access_names()));
  const double seed = anatomy.not_negative("seed");
  if (seed != std::floor(seed) || seed > 1e15) anatomy.refuse("seed");
  c.seed = static_cast<std::uint64_t>(seed);
  c.anatomy = person(c.seed, mean_of(dominance, access));
}

vascular::Composition read_composition(const JsonObject& entry) {
  const bool calcified = entry.boolean("calcified");
  vascular::Composition out = vascular::typical_composition(calcified);
  if (entry.has("calcium_arc_deg")) {
    out.calcium_arc_rad = entry.number("calcium_arc_deg") * units::pi / 180;
    if (out.calcified() != calcified) entry.refuse("calcium_arc_deg");
  }
  if (entry.has("calcium_thickness_mm")) out.calcium_thickness_m = entry.positive("calcium_thickness_mm") * 1e-3;
  if (entry.has("calcium_length_mm"))
    out.calcium_length_share = std::min(1.0, entry.positive("calcium_length_mm") / entry.positive("length_mm"));
  if (entry.has("hardness")) out.hardness = entry.positive("hardness");
  return out;
}

/// `own_beat`: frames that were given say what moves.
vascular::Lesion read_lesion(const JsonObject& entry, const vascular::Anatomy& anatomy, bool own_beat) {
  vascular::Lesion lesion{.branch = entry.text("branch"),
                          .from_m = (entry.has("at_branch") ? 0 : entry.not_negative("from_mm")) * 1e-3,
                          .length_m = entry.positive("length_mm") * 1e-3,
                          .stenosis = entry.number("stenosis_percent") / 100,
                          .eccentric = entry.choice("shape", {"concentric", "eccentric"}) == 1,
                          .made_of = read_composition(entry)};
  if (entry.has("side_deg")) {
    if (!lesion.eccentric) entry.refuse("side_deg");
    lesion.side_rad = entry.number("side_deg") * units::pi / 180;
  }
  if (entry.has("at_branch"))
    lesion.at_branch = entry.text("at_branch"), lesion.from_at_m = entry.number("from_mm") * 1e-3;
  try {
    place(anatomy, lesion);
    check(anatomy, lesion);
  } catch (const std::invalid_argument& error) {
    entry.value().fail(fmt::format("{}: {}", entry.value().path(), error.what()));
  }
  const int tube = find_branch(anatomy, lesion.branch)->tube;
  if (is_aorta(anatomy, tube) || !(own_beat || of_heart(anatomy, tube)))
    entry["branch"].refuse("a coronary artery; there is no lesion model for others");
  return lesion;
}

/// All of its files lie beside the case's file.
void read_imported(const JsonObject& imported, const fs::path& folder, Case& c) {
  const auto file = [&](const std::string& key, const std::string& name) {
    if (name.empty() || name != fs::path(name).filename().string()) imported.refuse(key);
    return (folder / name).string();
  };
  const auto beside = [&](const std::string& key) { return file(key, imported.text(key)); };
  ImportedVessels vessels;
  vessels.anatomy = load_anatomy(beside("anatomy"));
  std::vector<std::string> frames = {beside("lumen")};
  const bool sequence = imported.has("frames");
  if (sequence) {
    for (const JsonValue& value : imported.list("frames")) frames.push_back(file("frames", value.text));
    if (frames.size() < 4) imported.refuse("frames");
  }
  try {
    if (sequence)
      set_frames(read_mesh_sequence(frames, vascular::LengthUnit::millimetre, 0), vessels);
    else
      vessels.lumen = read_mesh(frames.front(), vascular::LengthUnit::millimetre, 0).mesh;
  } catch (const vascular::MeshError& error) {
    imported[std::string(sequence ? "frames" : "lumen")].fail(error.what());
  }
  c.imported = std::make_shared<const ImportedVessels>(std::move(vessels));
}

CaseView read_view(const JsonObject& view, const std::vector<CaseView>& before) {
  CaseView out{view.text("name"), view.number("lao_deg"), view.number("cran_deg")};
  if (fluoro::find_view(out.name)) view["name"].refuse("another name than those of the standard views");
  if (std::ranges::count(before, out.name, &CaseView::name) > 0) view["name"].refuse("a name that no other view has");
  return out;
}

/// `vessels`: instead of the files of an imported case; null: these.
Case case_of(const JsonValue& file, std::shared_ptr<const ImportedVessels> vessels = nullptr) {
  const JsonObject root(file, case_keys::root);
  Case c;
  if (root.text("schema") != "ostium-case/1") root.refuse("schema");
  c.name = root.text("name");
  if (c.name != fs::path(*file.file).stem().string()) root.refuse("name");
  c.title = root.text("title");
  c.card = read_card(JsonObject(root["card"], case_keys::card));
  if (root.has("anatomy") == root.has("imported"))
    file.fail("the case has both \"anatomy\" and \"imported\", or neither; expected one of them");
  if (root.has("anatomy"))
    read_anatomy(JsonObject(root["anatomy"], case_keys::anatomy), c);
  else if (const JsonObject imported(root["imported"], case_keys::imported); vessels)
    c.imported = std::move(vessels);
  else
    read_imported(imported, fs::path(*file.file).parent_path(), c);
  c.rate_1_min = root.positive("heart_rate_1_min");
  if (c.rate_1_min < vascular::least_rate_1_min || c.rate_1_min > vascular::highest_rate_1_min)
    root.refuse("heart_rate_1_min");
  const vascular::Anatomy anatomy = anatomy_of(c);
  for (const JsonValue& value : root.list("lesions"))
    c.lesions.push_back(
        read_lesion(JsonObject(value, case_keys::lesion), anatomy, c.imported && !c.imported->frames.empty()));
  try {
    vascular::check_apart(c.lesions);
  } catch (const std::invalid_argument& error) {
    root["lesions"].fail(fmt::format("{}: {}", root["lesions"].path(), error.what()));
  }
  if (root.has("views"))
    for (const JsonValue& value : root.list("views"))
      c.views.push_back(read_view(JsonObject(value, case_keys::view), c.views));
  return c;
}

/// An imported case's file has the name of its folder.
fs::path case_file_in(const fs::path& folder) {
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  return folder / (fs::absolute(named).filename().string() + ".json");
}

}  // namespace

const std::vector<std::string>& access_names() {
  static const std::vector<std::string> names = {"femoral", "radial"};
  return names;
}

Case read_case(const std::string& file, const std::string& text) { return case_of(parse_json(file, text)); }
Case read_case(const std::string& file, const std::string& text, std::shared_ptr<const ImportedVessels> vessels) {
  return case_of(parse_json(file, text), std::move(vessels));
}

Case load_case(const std::string& file) {
  if (is_markups_file(file))
    throw LoadError(file + ": holds centrelines, not a case; `ostium import` makes a case of them, `check` and " +
                    "`centreline` read them too");
  return case_of(load_json(file));
}

std::vector<Case> load_cases(std::vector<std::string>* unread) {
  const fs::path folder = fs::path(data_folder()) / "cases";
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty()) throw LoadError(folder.string() + ": has no case; expected a folder with at least one NAME.json");
  std::vector<Case> cases;
  for (const fs::path& file : files) cases.push_back(load_case(file.string()));
  for (const fs::directory_entry& entry : fs::directory_iterator(imported_folder(), error)) try {
      if (const fs::path file = case_file_in(entry.path()); is_file(file)) cases.push_back(load_case(file.string()));
    } catch (const LoadError& problem) {
      if (unread) unread->emplace_back(problem.what());
    }
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.name < b.name; });
  return cases;
}

std::string case_file(const std::string& name) {
  if (vascular::names_mesh(name) && is_file(name))
    throw LoadError(name + ": is a mesh; expected a case: `ostium import` makes one of it");
  if (name.empty()) throw LoadError("a case has no name; expected that of a case (`ostium cases`), its file or folder");
  const fs::path shipped = fs::path(data_folder()) / "cases" / (name + ".json");
  for (const fs::path& file :
       {shipped, case_file_in(fs::path(imported_folder()) / name), case_file_in(name), fs::path(name)})
    if (is_file(file)) return file.string();
  for (const fs::path& folder : {fs::path(imported_folder()) / name, fs::path(name)})
    if (is_folder(folder) && is_file(folder / "anatomy.json"))
      throw LoadError(
          fmt::format("{}: has no {}; expected a case's file with its folder's name: name the case's file, "
                      "or the folder as it was",
                      folder.string(), case_file_in(folder).filename().string()));
  if (is_there(name) && !is_folder(name)) require_file(name, "a case's file or folder");
  std::string known;
  for (const Case& c : load_cases()) known += "\n  " + c.name;
  throw LoadError(fmt::format("there is no case \"{}\"; expected a case's file or folder, or one of:{}", name, known));
}

Case find_case(const std::string& name) { return load_case(case_file(name)); }

std::string imported_folder() {
  const auto set = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::string(value ? value : "");
  };
  if (!set("OSTIUM_CASES").empty()) return set("OSTIUM_CASES");
  if (!set("XDG_DATA_HOME").empty()) return (fs::path(set("XDG_DATA_HOME")) / "ostium" / "cases").string();
  std::string home = set("HOME");
  if (const passwd* user = home.empty() ? getpwuid(getuid()) : nullptr) home = user->pw_dir;
  if (home.empty()) home = "/";  // never wherever a command happens to run
  return (fs::path(home) / ".local" / "share" / "ostium" / "cases").string();
}

Case with_person(const Case& c, std::uint64_t seed) {
  if (c.imported) throw LoadError(c.name + ": it is one person's mesh; another person cannot be drawn for it");
  Case out = c;
  out.seed = seed;
  out.anatomy = person(seed, mean_of(c.anatomy.dominance, c.anatomy.access));
  constexpr double rounding_m = 1e-9;
  const vascular::Anatomy anatomy = anatomy_of(out);
  std::uint64_t number = 0;
  for (vascular::Lesion& lesion : out.lesions) {
    place(anatomy, lesion);
    if (seed != 0) lesion.made_of = vascular::draw_composition(lesion.made_of.calcified(), seed, number++);
    if (const vascular::NamedBranch* branch = find_branch(anatomy, lesion.branch);
        branch && branch->length_m() > lesion.length_m)
      lesion.from_m = std::min(lesion.from_m, branch->length_m() - lesion.length_m - rounding_m);
  }
  return out;
}

vascular::Patient patient_of(const Case& c) {
  return c.imported ? make_patient(c.imported->anatomy, c.imported->lumen, c.lesions, c.imported->frames)
                    : make_patient(c.anatomy, c.lesions);
}

void set_frames(std::vector<vascular::Mesh> frames, ImportedVessels& vessels) {
  std::vector<std::vector<Eigen::Vector3d>> vertices;
  for (const vascular::Mesh& frame : frames) vertices.push_back(frame.vertices);
  vessels.frames = vascular::resampled(vertices, vascular::beat_frames);
  vessels.lumen = std::move(frames.front());
}

vascular::Anatomy anatomy_of(const Case& c) { return c.imported ? c.imported->anatomy : build_anatomy(c.anatomy); }

}  // namespace ostium::data
