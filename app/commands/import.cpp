#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/mesh_unit.h"
#include "app/command_line/progress.h"
#include "core/base/units.h"
#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/case/mesh_picture.h"
#include "data/catalogue/case/tree_file.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "vascular/anatomy/labelling/labelling.h"
#include "vascular/anatomy/labelling/narrowings.h"
#include "vascular/geometry/mesh/patient_frame.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh/written_mesh.h"
#include "vascular/geometry/repair/repair.h"
#include "vascular/geometry/repair/units.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using units::mm;

struct ImportArguments {
  std::vector<std::string> files;
  std::string output;                ///< a folder, or the name of a case
  std::string unit = "auto";         ///< auto, mm, cm, m or in
  std::string axes = "auto";         ///< where the file's x, y, z point to: three letters of L, R, S, I, A, P
  std::string entry;                 ///< "x,y,z" in the file's unit and axes
  std::vector<std::string> renames;  ///< "3=OM1"
  std::vector<std::string> lesions;  ///< "RCA:40:12:75": branch, from mm, length mm, percent of the diameter
  bool sequence = false;             ///< the files are frames of one beat, from the R wave on
  std::string title;
  double voxel_mm = 0;
  double longest_gap_mm = 8;
  std::string picture;
  bool json = false;
};

void declare(Options& options, ImportArguments& a) {
  options.add("mesh", a.files, "STL, OBJ, PLY, glTF, ...; several are one patient's parts").type("MESH").required();
  options.flag("--sequence", a.sequence,
               "The files, or those of a folder, are one surface through a beat, from the R wave on");
  options.add("-o,--out", a.output, "A folder for the case, or a name to keep it under").type("DIR|NAME").required();
  add_guessed_unit_option(options, a.unit, "What a number in the files means");
  options.add("--axes", a.axes, "Where x, y, z point to: LPS, RAS, LSA, ...; auto tells by the anatomy").show_default();
  options.add("--entry", a.entry, "Instruments enter at the centreline's point nearest to this one").type("X,Y,Z");
  options.add("--rename", a.renames, "Another name for a branch that was found").type("FOUND=WANTED");
  options.add("--lesion", a.lesions, "A narrowing to put in: branch, from mm, length mm, %")
      .type("BRANCH:FROM:LENGTH:PERCENT");
  options.add("--title", a.title, "What people call it");
  options.add("--voxel", a.voxel_mm, "Of the level set, mm; 0: by the narrowest vessels")
      .range(0.0, 5.0)
      .show_default();
  options.add("--longest-gap", a.longest_gap_mm, "No gap is bridged that is longer, mm")
      .range(0.0, 50.0)
      .show_default();
  options.add("--picture", a.picture, "What came out of it, with mends and names").type("FILE.png|FILE.svg");
  options.flag("--json", a.json, "What was found and mended, machine-readable");
}

/// Where the files' axes point to, as DICOM has its letters: left or right, superior or inferior, anterior or
/// posterior.
Eigen::Matrix3d axes_of(const std::string& letters) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  const std::string known = "LRSIAP";
  for (std::size_t i = 0; i < letters.size() && letters.size() == 3; ++i)
    if (const auto k = known.find(letters[i]); k != std::string::npos)
      R(static_cast<int>(k / 2), static_cast<int>(i)) = k % 2 ? -1 : 1;
  if (std::fabs(R.determinant() - 1) > 1e-9)
    throw data::LoadError(fmt::format(
        "the axes \"{}\" are no right-handed row of three; expected for instance LPS (DICOM), RAS or LSA", letters));
  return R;
}

vascular::Lesion lesion_of(const std::string& text) {
  const auto colon = text.find(':');
  double from, length, percent;
  char rest;
  if (colon == std::string::npos ||
      std::sscanf(text.c_str() + colon, ":%lf:%lf:%lf%c", &from, &length, &percent, &rest) != 3)
    throw data::LoadError(fmt::format(
        "the lesion \"{}\" is not BRANCH:FROM:LENGTH:PERCENT; expected for instance RCA:40:12:75 (mm, mm, %)", text));
  return {.branch = text.substr(0, colon), .from_m = from * mm, .length_m = length * mm, .stenosis = percent / 100};
}

std::map<std::string, std::string> names_of(const std::vector<std::string>& renames) {
  std::map<std::string, std::string> names;
  for (const std::string& rename : renames) {
    const auto [found, wanted] = key_and_value(rename);
    if (found.empty() || wanted.empty())
      throw data::LoadError(fmt::format("\"{}\" is not FOUND=WANTED; expected for instance --rename 3=OM1", rename));
    names[found] = wanted;
  }
  return names;
}

Json places(const std::vector<Eigen::Vector3d>& where) {
  Json list = Json::array();
  for (const Eigen::Vector3d& p : where) list.push_back({p.x() / mm, p.y() / mm, p.z() / mm});
  return list;
}

class Import {
 public:
  explicit Import(const ImportArguments& options) : options_(options) {}

  int run() {
    prepare();
    if (options_.sequence) {
      read_sequence();
    } else {
      read();
      mend_mesh();
    }
    recognise_vessels();
    make_case();
    write();
    tell();
    return 0;
  }

 private:
  /// What can be refused before the work.
  void prepare() {
    if (options_.axes != "auto") wanted_.axes = axes_of(options_.axes);
    wanted_.names = names_of(options_.renames);
    if (!options_.entry.empty()) mesh_point(options_.entry);
    for (const std::string& text : options_.lesions) case_.lesions.push_back(lesion_of(text));
    if (!options_.picture.empty()) require_ending(options_.picture, {".png", ".svg"});
    const bool name_only = options_.output.find('/') == std::string::npos && !options_.output.starts_with(".");
    folder_ = name_only ? fs::path(data::imported_folder()) / options_.output : fs::path(options_.output);
    if (!folder_.has_filename()) folder_ = folder_.parent_path();
    case_.name = fs::absolute(folder_).filename().string();
    if (fs::exists(folder_) && !fs::exists(folder_ / (case_.name + ".json")) && !fs::is_empty(folder_))
      throw data::LoadError(folder_.string() +
                            ": is there and holds no imported case; expected a new folder, or one to renew");
  }

  void read() {
    progress_("reading");
    vascular::Mesh raw;
    for (const std::string& file : options_.files) {
      const vascular::MeshFile found = read_mesh(file, vascular::LengthUnit::metre, 0);
      skipped_ += found.skipped_faces;
      append(raw, found.mesh);
    }
    const double scale = metres(find_unit(raw));
    for (Eigen::Vector3d& p : raw.vertices) p *= scale;
    mesh_ = welded(raw);
  }

  vascular::LengthUnit find_unit(const vascular::Mesh& raw) {
    triangles_ = static_cast<int>(raw.triangles.size());
    progress_(fmt::format("{} triangles; looking for their unit", triangles_));
    unit_ = guess_unit(raw);
    if (options_.unit != "auto") {
      take_unit(vascular::unit_named(options_.unit), unit_);
    } else if (!unit_.vessel) {
      throw vascular::MeshError(fmt::format(
          "{}: no unit makes a vessel of this: as {} it is {:.0f} mm long and {:.1f} mm wide; if it is one, say its "
          "unit with --units",
          options_.files.front(), name_of(unit_.unit), unit_.extent_m / mm, unit_.calibre_m / mm));
    }
    if (!options_.entry.empty()) wanted_.entry = metres(unit_.unit) * mesh_point(options_.entry);
    return unit_.unit;
  }

  /// Of one surface through a beat. Nothing is mended: every frame would be mended otherwise.
  void read_sequence() {
    files_ = options_.files;
    if (files_.size() == 1 && fs::is_directory(files_.front())) files_ = numbered_meshes(files_.front());
    if (files_.size() < 4)
      throw vascular::MeshError(fmt::format("{}: a sequence has at least 4 frames of a beat, here are {}",
                                            options_.files.front(), files_.size()));
    progress_(fmt::format("reading {} frames, the first is {}", files_.size(), files_.front()));
    frames_ = read_mesh_sequence(files_, vascular::LengthUnit::metre, 0);
    const double scale = metres(find_unit(frames_.front()));
    for (vascular::Mesh& frame : frames_)
      for (Eigen::Vector3d& p : frame.vertices) p *= scale;
    if (volume_m3(frames_.front()) < 0)
      for (vascular::Mesh& frame : frames_)
        for (auto& t : frame.triangles) std::swap(t[1], t[2]);
    const vascular::SurfaceReport report = check_surface(frames_.front());
    if (!report.closed())
      throw vascular::MeshError(
          fmt::format("{}: is not closed, and a sequence cannot be mended: {}`ostium check` says where", files_.front(),
                      describe(report)));
    mended_.lumen = frames_.front();
    mended_.lumens = report.components;
  }

  /// The meshes of a folder that have one name and a number, by the number.
  static std::vector<std::string> numbered_meshes(const std::string& folder) {
    std::map<std::pair<std::string, std::string>, std::map<long, std::string>> rows;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string stem = entry.path().stem().string(), ending = entry.path().extension().string();
      const auto digits = stem.find_last_not_of("0123456789") + 1;
      if (!entry.is_regular_file() || digits == stem.size() || stem.size() - digits > 9) continue;
      if (std::string known = ".obj.ply.stl.gltf.glb.dae.fbx.off.3ds.x3d"; known.find(ending) == std::string::npos)
        continue;
      rows[{stem.substr(0, digits), ending}][std::stol(stem.substr(digits))] = entry.path().string();
    }
    const auto longest = std::max_element(
        rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    std::vector<std::string> files;
    if (longest != rows.end())
      for (const auto& [number, file] : longest->second) files.push_back(file);
    return files;
  }

  static vascular::Mesh welded(const vascular::Mesh& raw) {
    const std::vector<int> vertex_of = vascular::weld(raw.vertices, vascular::default_weld_m);
    vascular::Mesh mesh;
    for (std::size_t i = 0; i < raw.vertices.size(); ++i)
      if (vertex_of[i] == static_cast<int>(mesh.vertices.size())) mesh.vertices.push_back(raw.vertices[i]);
    for (const auto& [a, b, c] : raw.triangles)
      if (vertex_of[a] != vertex_of[b] && vertex_of[b] != vertex_of[c] && vertex_of[c] != vertex_of[a])
        mesh.triangles.push_back({vertex_of[a], vertex_of[b], vertex_of[c]});
    return mesh;
  }

  void mend_mesh() {
    vascular::RepairOptions options;
    options.voxel_m = options_.voxel_mm * mm;
    options.longest_gap_m = options_.longest_gap_mm * mm;
    options.progress = std::ref(progress_);
    mended_ = repair_mesh(std::move(mesh_), options);
  }

  void recognise_vessels() {
    wanted_.progress = std::ref(progress_);
    found_ = label_vessels(mended_.lumen, wanted_);
    found_.lumen = as_written(std::move(found_.lumen), vascular::LengthUnit::millimetre);
    const vascular::SurfaceReport report = check_surface(found_.lumen);
    if (!report.sound())
      found_.notes.push_back("the lumen is not sound: " + describe(report).substr(0, describe(report).find('\n')));
  }

  void make_case() {
    progress_(frames_.empty() ? "laying the heart's motion on it" : "carrying the tree along its frames");
    case_.title =
        options_.title.empty() ? "Imported: " + fs::path(options_.files.front()).filename().string() : options_.title;
    case_.card = {"Imported from " + fs::path(options_.files.front()).filename().string() + ".", "Not known.",
                  "From the entry that was chosen at import"};
    auto vessels = std::make_shared<data::ImportedVessels>();
    vessels->anatomy = found_.anatomy;
    if (frames_.empty())
      vessels->lumen = found_.lumen;
    else
      lay_frames(*vessels);
    case_.imported = vessels;
    try {
      patient_ = patient_of(case_);
    } catch (const std::invalid_argument& error) {
      throw data::LoadError(error.what());
    }
    for (const vascular::FoundNarrowing& narrowing : find_narrowings(patient_.tree))
      if (coronary(find_branch(found_.anatomy, narrowing.branch)->tube)) narrowings_.push_back(narrowing);
    const vascular::SurfaceReport systole = vascular::check_surface(patient_.lumen.at(vascular::end_systole, 0));
    if (systole.crossings.count > 0) {
      const Eigen::Vector3d p = systole.crossings.where.front() / mm;
      found_.notes.push_back(fmt::format(
          "at end-systole {} pairs of triangles cross, the first at {:.1f} {:.1f} {:.1f} mm of the patient frame",
          systole.crossings.count, p.x(), p.y(), p.z()));
    }
  }

  /// Into the patient frame, as the files of the case will have them.
  void lay_frames(data::ImportedVessels& vessels) {
    for (vascular::Mesh& frame : frames_) {
      for (Eigen::Vector3d& p : frame.vertices) p = found_.R_PF * p - found_.shift_P;
      frame = as_written(std::move(frame), vascular::LengthUnit::millimetre);
    }
    frames_.front() = found_.lumen;
    set_frames(frames_, vessels);
  }

  std::string frame_name(std::size_t f) const { return f ? fmt::format("lumen-{:02}.ply", f) : "lumen.ply"; }

  Json imported_json() const {
    Json out = {{"anatomy", "anatomy.json"}, {"lumen", frame_name(0)}};
    for (std::size_t f = 1; f < frames_.size(); ++f) out["frames"].push_back(frame_name(f));
    return out;
  }

  std::string case_json() const {
    Json lesions = Json::array();
    for (const vascular::Lesion& l : case_.lesions)
      lesions.push_back({{"branch", l.branch},
                         {"from_mm", l.from_m / mm},
                         {"length_mm", l.length_m / mm},
                         {"stenosis_percent", 100 * l.stenosis},
                         {"shape", "concentric"},
                         {"calcified", false}});
    const Json json = {
        {"schema", "ostium-case/1"},
        {"name", case_.name},
        {"title", case_.title},
        {"card",
         {{"history", case_.card.history}, {"ecg", case_.card.ecg}, {"planned_access", case_.card.planned_access}}},
        {"imported", imported_json()},
        {"heart_rate_1_min", case_.rate_1_min},
        {"lesions", lesions}};
    return json.dump(2) + "\n";
  }

  Json report() const {
    Json mends = Json::array(), branches = Json::array(), narrow = Json::array();
    for (const vascular::RepairNote& note : mended_.notes)
      mends.push_back({{"what", note.what}, {"count", note.count}, {"where_mm", places(note.where)}});
    const vascular::Anatomy& a = found_.anatomy;
    for (const vascular::NamedBranch& b : a.branches)
      branches.push_back({{"name", b.name},
                          {"length_mm", b.length_m() / mm},
                          {"proximal_mm", 2 * a.tubes[static_cast<std::size_t>(b.tube)].at(b.from_m).radius_m / mm},
                          {"distal_mm", 2 * a.tubes[static_cast<std::size_t>(b.tube)].at(b.to_m).radius_m / mm}});
    for (const vascular::FoundNarrowing& n : narrowings_)
      narrow.push_back({{"branch", n.branch}, {"at_mm", n.at_m / mm}, {"stenosis_percent", 100 * n.stenosis}});
    const Eigen::Matrix3d& R = found_.R_PF;
    return {{"case", case_.name},
            {"files", options_.files},
            {"triangles_in", triangles_},
            {"unit", name_of(unit_.unit)},
            {"unit_said", options_.unit != "auto"},
            {"extent_mm", unit_.extent_m / mm},
            {"lumens", mended_.lumens},
            {"triangles", found_.lumen.triangles.size()},
            {"volume_mL", 1e6 * volume_m3(found_.lumen)},
            {"sound", check_surface(found_.lumen).sound()},
            {"beats", patient_.lumen.moving > 0},
            {"voxel_mm", mended_.voxel_m / mm},
            {"mends", mends},
            {"aorta_rms_mm", found_.aorta_rms_m / mm},
            {"heart_rms_mm", found_.heart_rms_m / mm},
            {"axes", {{R(0, 0), R(0, 1), R(0, 2)}, {R(1, 0), R(1, 1), R(1, 2)}, {R(2, 0), R(2, 1), R(2, 2)}}},
            {"origin_mm", {found_.shift_P.x() / mm, found_.shift_P.y() / mm, found_.shift_P.z() / mm}},
            {"branches", branches},
            {"narrowings", narrow},
            {"notes", found_.notes}};
  }

  /// Beside its place first, then moved there: a case is there whole or not at all.
  void write() const {
    progress_("writing");
    std::error_code error;
    if (folder_.has_parent_path()) fs::create_directories(folder_.parent_path(), error);
    const fs::path unfinished = folder_.string() + ".unfinished";
    fs::remove_all(unfinished, error);
    fs::create_directory(unfinished, error);
    if (error)
      throw data::LoadError(
          fmt::format("{}: cannot be made ({}); expected a folder", unfinished.string(), error.message()));
    try {
      data::write_file((unfinished / (case_.name + ".json")).string(), case_json());
      data::write_file((unfinished / "anatomy.json").string(), data::anatomy_to_json(found_.anatomy));
      data::write_file((unfinished / "import.json").string(), report().dump(2) + "\n");
      write_mesh((unfinished / frame_name(0)).string(), found_.lumen, vascular::LengthUnit::millimetre);
      for (std::size_t f = 1; f < frames_.size(); ++f)
        write_mesh((unfinished / frame_name(f)).string(), frames_[f], vascular::LengthUnit::millimetre);
      data::write_tree((unfinished / "tree.json").string(), patient_.tree);
      data::write_tree((unfinished / "tree.vtp").string(), patient_.tree);
      if (!options_.picture.empty()) draw();
    } catch (...) {
      fs::remove_all(unfinished, error);
      throw;
    }
    fs::remove_all(folder_, error);
    fs::rename(unfinished, folder_, error);
    if (error) {
      const std::string why = error.message();
      fs::remove_all(unfinished, error);
      throw data::LoadError(fmt::format("{}: cannot be written ({})", folder_.string(), why));
    }
  }

  bool coronary(int tube) const {
    for (; tube >= 0; tube = found_.anatomy.tubes[static_cast<std::size_t>(tube)].parent)
      for (const char* name : {"LAD", "LCx", "RCA"})
        if (found_.anatomy.tubes[static_cast<std::size_t>(tube)].name == name) return true;
    return false;
  }

  void draw() const {
    const vascular::Mesh mesh = patient_.lumen.at(0, 0);
    std::vector<Eigen::Vector3d> rgb;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      Eigen::Vector3d colour = Eigen::Vector3d::Zero();
      double sum = 0;
      for (const vascular::TubeShare& share : patient_.lumen.shares[v]) {
        const bool beats = v < patient_.lumen.moving;
        colour += share.weight * (coronary(share.tube) ? Eigen::Vector3d(214, 72, 60)
                                  : beats              ? Eigen::Vector3d(220, 160, 150)
                                                       : Eigen::Vector3d(205, 200, 192));
        sum += share.weight;
      }
      rgb.push_back(colour / std::max(sum, 1e-9));
    }
    std::vector<data::PictureMark> marks;
    for (const vascular::NamedBranch& b : found_.anatomy.branches) {
      const vascular::Tube& tube = found_.anatomy.tubes[static_cast<std::size_t>(b.tube)];
      marks.push_back({tube.at((b.from_m + b.to_m) / 2).p, b.name, {30, 60, 150}});
    }
    for (const vascular::RepairNote& note : mended_.notes)
      for (const Eigen::Vector3d& p : note.where)
        marks.push_back({found_.R_PF * p - found_.shift_P, "", {20, 140, 60}});
    marks.push_back({found_.anatomy.landmarks.p_access, "entry", {200, 30, 160}});
    draw_mesh(options_.picture, mesh, rgb, marks,
              fmt::format("{}: red beats, green was mended, blue are branches", case_.name));
  }

  void tell() const {
    show_progress("");
    if (options_.json) {
      fmt::print("{}\n", report().dump(2));
      return;
    }
    fmt::print("{}: {} triangles, {} closed lumen{}, {:.1f} mL, {}\n", folder_.string(), found_.lumen.triangles.size(),
               mended_.lumens, mended_.lumens == 1 ? "" : "s", 1e6 * volume_m3(found_.lumen),
               !frames_.empty()            ? fmt::format("beating in {} frames", frames_.size())
               : found_.heart              ? "beating"
               : patient_.lumen.moving > 0 ? "beating at the root of the aorta"
                                           : "still");
    fmt::print("units: {}, {}: {:.0f} mm long, {:.1f} mm wide{}\n", name_of(unit_.unit),
               options_.unit == "auto" ? "guessed" : "as you said", unit_.extent_m / mm, unit_.calibre_m / mm,
               options_.unit == "auto" && !unit_.certain ? "; confirm with --units, others are possible" : "");
    if (skipped_) fmt::print("{} points or lines in the files were left out\n", skipped_);
    for (const vascular::RepairNote& note : mended_.notes) {
      fmt::print("mended: {} x {}", note.count, note.what);
      if (!note.where.empty()) {
        const Eigen::Vector3d p = note.where.front() / metres(unit_.unit);
        fmt::print(", the first at {:.4g} {:.4g} {:.4g}", p.x(), p.y(), p.z());
      }
      fmt::print("\n");
    }
    if (found_.aorta_rms_m > 0)
      fmt::print("aorta: {:.1f} mm from the mean one's course (rms)\n", found_.aorta_rms_m / mm);
    if (found_.heart)
      fmt::print("coronary arteries: {:.1f} mm from the mean ones' courses (rms)\n", found_.heart_rms_m / mm);
    const vascular::Anatomy& a = found_.anatomy;
    fmt::print("  {:<18} {:>9} {:>12} {:>10}\n", "branch", "length mm", "proximal mm", "distal mm");
    for (const vascular::NamedBranch& b : a.branches)
      fmt::print("  {:<18} {:9.1f} {:12.2f} {:10.2f}\n", b.name, b.length_m() / mm,
                 2 * a.tubes[static_cast<std::size_t>(b.tube)].at(b.from_m).radius_m / mm,
                 2 * a.tubes[static_cast<std::size_t>(b.tube)].at(b.to_m).radius_m / mm);
    for (const vascular::FoundNarrowing& n : narrowings_)
      fmt::print("narrowing kept: {} at {:.0f} mm, {:.0f} % of {:.1f} mm\n", n.branch, n.at_m / mm, 100 * n.stenosis,
                 n.reference_m / mm);
    for (const std::string& note : found_.notes) fmt::print("note: {}\n", note);
    fmt::print("rehearse on it as on any case: ostium cases {0}\n",
               options_.output.find('/') == std::string::npos ? case_.name : folder_.string());
  }

  const ImportArguments& options_;
  TimedProgress progress_;
  fs::path folder_;
  data::Case case_;
  vascular::LabellingOptions wanted_;
  vascular::Mesh mesh_;
  std::vector<std::string> files_;      ///< of a sequence,
  std::vector<vascular::Mesh> frames_;  ///< and its surfaces; empty: one that is at rest
  int skipped_ = 0, triangles_ = 0;
  vascular::UnitGuess unit_;
  vascular::RepairedMesh mended_;
  vascular::LabelledVessels found_;
  vascular::Patient patient_;
  std::vector<vascular::FoundNarrowing> narrowings_;
};

int run(const ImportArguments& arguments) { return Import(arguments).run(); }

}  // namespace

Command import_command() {
  return make_command("import", "Anyone's own mesh becomes a case: mended, named, beating",
                      {"ostium import aorta.stl coronaries.stl -o anna --picture anna.svg",
                       "ostium import aorta.obj -o cases/aorta --units mm --entry -5,18,-11 --rename 3=coeliac",
                       "ostium import heart.ply -o tight-rca --lesion RCA:40:12:75 && ostium cases tight-rca",
                       "ostium import frames/ --sequence -o beating-heart"},
                      declare, run);
}

}  // namespace ostium::app
