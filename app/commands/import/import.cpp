#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/progress.h"
#include "app/command_line/read_vessel.h"
#include "app/commands/import/file_axes.h"
#include "app/commands/import/imported.h"
#include "app/commands/import/mesh_files.h"
#include "core/base/units.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "vascular/anatomy/editing/edit_anatomy.h"
#include "vascular/anatomy/labelling/labelling.h"
#include "vascular/anatomy/labelling/narrowings.h"
#include "vascular/geometry/centreline/reach.h"
#include "vascular/geometry/mesh/patient_frame.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh_files/open_end.h"
#include "vascular/geometry/mesh_files/rounding.h"
#include "vascular/geometry/mesh_files/written_mesh.h"
#include "vascular/geometry/repair/repair.h"
#include "vascular/motion/frame_order.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/patient/patient_tree.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
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
  std::string motion = "auto";       ///< auto, none, own or coronary
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
  options
      .add("--motion", a.motion,
           "none: still, with numbers for names; own: the files' frames; coronary: a heart's, as which it is named; "
           "auto: own, or coronary where it is recognised")
      .one_of({"auto", "none", "own", "coronary"})
      .show_default();
  options.add("-o,--out", a.output, "A folder for the case, or a name to keep it under").type("DIR|NAME").required();
  add_unit_option(options, a.unit, "What a number in the files means");
  options.add("--axes", a.axes, "Where x, y, z point to: LPS, RAS, LSA, ...; auto: as the files say, or by the anatomy")
      .show_default();
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
  options.add("--picture", a.picture, "What came out of it, with mends and names").type("FILE.png|FILE.svg").writes();
  options.flag("--json", a.json, "What was found and mended, machine-readable");
}

vascular::Lesion lesion_of(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  std::optional<double> from, length, percent;
  if (parts.size() == 4)
    from = data::decimal(parts[1]), length = data::decimal(parts[2]), percent = data::decimal(parts[3]);
  if (!from || !length || !percent)
    throw data::LoadError(fmt::format(
        "the lesion \"{}\" is not BRANCH:FROM:LENGTH:PERCENT; expected for instance RCA:40:12:75 (mm, mm, %)", text));
  return {.branch = parts[0], .from_m = *from * mm, .length_m = *length * mm, .stenosis = *percent / 100};
}

std::map<std::string, std::string> names_of(const std::vector<std::string>& renames) {
  std::map<std::string, std::string> names;
  for (const std::string& rename : renames) {
    const auto [found, wanted] = key_and_value(rename);
    if (found.empty() || wanted.empty())
      throw data::LoadError(fmt::format("\"{}\" is not FOUND=WANTED; expected for instance --rename 3=OM1", rename));
    if (!vascular::is_branch_name(wanted))
      throw data::LoadError(
          fmt::format("--rename \"{}\": expected a name of at most 40 letters, digits, spaces, - and _", rename));
    if (!names.try_emplace(found, wanted).second)
      throw data::LoadError(fmt::format("--rename \"{}\": {} gets another name already; expected one", rename, found));
  }
  return names;
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
      repair(0);
    }
    label();
    look_closer();
    make_case();
    progress_("writing");
    write_case(made_, report_of(made_), options_.picture);
    show_progress("");
    if (options_.json)
      fmt::print("{}\n", report_of(made_).dump(2));
    else
      tell(made_, options_.output.find('/') == std::string::npos ? made_.the_case.name : made_.folder.string());
    return 0;
  }

 private:
  /// What can be refused before the work.
  void prepare() {
    made_.files = options_.files;
    choose_motion();
    if (options_.axes != "auto") axes_of(options_.axes);
    wanted_.names = names_of(options_.renames);
    if (!options_.entry.empty()) mesh_point(options_.entry);
    for (const std::string& text : options_.lesions) made_.the_case.lesions.push_back(lesion_of(text));
    try {
      vascular::check_apart(made_.the_case.lesions);
    } catch (const std::invalid_argument& error) {
      throw data::LoadError(fmt::format("--lesion: {}", error.what()));
    }
    if (!options_.picture.empty()) require_ending(options_.picture, {".png", ".svg"});
    const bool name_only = options_.output.find('/') == std::string::npos && !options_.output.starts_with(".");
    made_.folder = name_only ? fs::path(data::imported_folder()) / options_.output : fs::path(options_.output);
    if (!made_.folder.has_filename()) made_.folder = made_.folder.parent_path();
    // Where a folder on the way is made first, ".." leads elsewhere than it seems to.
    for (const fs::path& part : fs::path(made_.folder))
      if (std::error_code none; part == "..")
        if (const fs::path whole = fs::weakly_canonical(made_.folder, none); !none) made_.folder = whole;
    made_.the_case.name = fs::absolute(made_.folder).filename().string();
    if (name_only && data::is_there(fs::path(data::data_folder()) / "cases" / (options_.output + ".json")))
      throw data::LoadError(fmt::format(
          "-o {}: is a case that ships, and would hide this one; expected another name, or a folder", options_.output));
    require_new_or_case(made_.folder, made_.the_case.name);
    require_picture_elsewhere();
    made_.folder_written_at = written_at(made_.folder);
  }

  /// The case appears as a whole, and is renewed as a whole.
  void require_picture_elsewhere() const {
    if (options_.picture.empty()) return;
    std::error_code none;
    const fs::path picture = fs::weakly_canonical(fs::absolute(options_.picture, none), none),
                   folder = fs::weakly_canonical(fs::absolute(made_.folder, none), none);
    if (std::mismatch(folder.begin(), folder.end(), picture.begin(), picture.end()).first == folder.end())
      throw data::LoadError(
          fmt::format("--picture {}: would lie in {}, which holds the case alone; expected another place",
                      options_.picture, made_.folder.string()));
  }

  void choose_motion() {
    if (options_.sequence ? options_.motion == "none" || options_.motion == "coronary" : options_.motion == "own")
      throw data::LoadError(
          options_.sequence
              ? fmt::format("--motion {} with --sequence, whose frames are the motion; leave one of them out",
                            options_.motion)
              : "--motion own is that of several files, frames of one beat; add --sequence, or say --motion none");
    if (options_.motion == "none") wanted_.heart = vascular::HeartSearch::none;
    if (options_.motion == "coronary") wanted_.heart = vascular::HeartSearch::assumed;
  }

  void read() {
    progress_("reading");
    vascular::Mesh raw;
    files_ = options_.files;
    find_axes();
    for (const std::string& file : files_) {
      const vascular::MeshFile found = read_vessel(file, vascular::LengthUnit::metre, 0);
      made_.skipped += found.skipped_faces;
      append(raw, found.mesh);
    }
    const double scale = metres(find_unit(options_.files, raw));
    for (Eigen::Vector3d& p : raw.vertices) p *= scale;
    place_entry(raw);
    mesh_ = welded(raw);
  }

  void find_axes() {
    made_.axes = file_axes(files_, options_.axes);
    if (!made_.axes.letters.empty()) wanted_.axes = axes_of(made_.axes.letters);
  }

  void place_entry(const vascular::Mesh& mesh) {
    if (!options_.entry.empty()) wanted_.entry = point_of(mesh, made_.unit.unit, options_.entry);
  }

  vascular::LengthUnit find_unit(const std::vector<std::string>& files, const vascular::Mesh& raw) {
    made_.triangles = static_cast<int>(raw.triangles.size());
    progress_(fmt::format("{} triangles; looking for their unit", made_.triangles));
    made_.unit = unit_of(files, raw, options_.unit);
    require_known(files.front(), made_.unit);
    rounding_m_ = metres(made_.unit.unit) * rounding_step(raw);
    return made_.unit.unit;
  }

  /// Of one surface through a beat. Nothing is repaired: every frame would be repaired in another way.
  void read_sequence() {
    files_ = options_.files;
    if (files_.size() == 1 && data::is_folder(files_.front())) files_ = numbered_meshes(files_.front());
    if (files_.size() < 4)
      throw vascular::MeshError(fmt::format("{}: a sequence has at least 4 frames of a beat, here are {}",
                                            options_.files.front(), files_.size()));
    find_axes();
    progress_(fmt::format("reading {} frames, the first is {}", files_.size(), files_.front()));
    made_.frames = read_mesh_sequence(files_, vascular::LengthUnit::metre, 0);
    const double scale = metres(find_unit(files_, made_.frames.front()));
    for (vascular::Mesh& frame : made_.frames)
      for (Eigen::Vector3d& p : frame.vertices) p *= scale;
    doubts_of_frames_ = vascular::doubts_of_frames(made_.frames, files_);
    place_entry(made_.frames.front());
    if (volume_m3(made_.frames.front()) < 0)
      for (vascular::Mesh& frame : made_.frames)
        for (auto& t : frame.triangles) std::swap(t[1], t[2]);
    const vascular::SurfaceReport report = check_surface(made_.frames.front());
    if (!report.closed())
      throw vascular::MeshError(
          fmt::format("{}: is not closed, and a sequence cannot be mended: {}`ostium check` says where", files_.front(),
                      describe(report)));
    made_.repaired.lumen = made_.frames.front();
    made_.repaired.lumens = report.components;
  }

  void repair(double narrowest_m) {
    vascular::RepairOptions options;
    options.voxel_m = options_.voxel_mm * mm;
    options.narrowest_m = narrowest_m;
    options.longest_gap_m = options_.longest_gap_mm * mm;
    options.progress = std::ref(progress_);
    made_.repaired = repair_mesh(mesh_, options);
  }

  void label() {
    wanted_.progress = std::ref(progress_);
    made_.found = label_vessels(made_.repaired.lumen, wanted_);
    // Coronary arteries are known by their names.
    if (!made_.found.heart)
      for (const auto& [found, wanted] : wanted_.names)
        for (const char* beating : {"LM", "LAD", "LCx", "RCA"})
          if (wanted == beating)
            throw data::LoadError(
                fmt::format("--rename {}={}: no heart was recognised, and a coronary artery beats; expected another "
                            "name, or --motion coronary",
                            found, wanted));
    made_.found.lumen = as_written(std::move(made_.found.lumen), vascular::LengthUnit::millimetre);
    const vascular::SurfaceReport report = check_surface(made_.found.lumen);
    crossing_at_rest_ = report.crossings.count;
    if (!report.sound())
      made_.found.notes.push_back("the lumen is not sound: " + describe(report).substr(0, describe(report).find('\n')));
    if (rounding_m_ > vascular::rounding_matters * made_.unit.calibre_m)
      made_.found.notes.push_back(
          fmt::format("the file's numbers are {:.2g} mm apart and hide what is finer: save it with more digits, or "
                      "moved to its origin",
                      rounding_m_ / mm));
    for (const std::string& file : files_)
      if (const std::string doubt = vascular::doubt_of_mesh_end(file); !doubt.empty())
        made_.found.notes.push_back(doubt);
    for (const std::string& doubt : doubts_of_frames_) made_.found.notes.push_back(doubt);
  }

  /// Once more on a finer grid, where a throat is too narrow for the first and came out narrower still, or hardly at
  /// all: then no line leads on behind it.
  void look_closer() {
    if (options_.sequence || made_.repaired.voxel_m <= made_.repaired.finest_m) return;
    const vascular::SphereTree tree = tree_of(made_.found.anatomy, {}, made_.found.lumen);
    double narrowest_m = vascular::narrowest_m(find_narrowings(tree));
    if (unreached(made_.found.lumen, tree).share > vascular::unreached_matters)
      narrowest_m = vascular::voxels_across * made_.repaired.finest_m;
    if (narrowest_m == 0 || narrowest_m > vascular::voxels_across * made_.repaired.voxel_m) return;
    repair(narrowest_m);
    label();
  }

  void make_case() {
    progress_(made_.frames.empty() ? "laying the heart's motion on it" : "carrying the tree along its frames");
    made_.the_case.title =
        options_.title.empty() ? "Imported: " + fs::path(options_.files.front()).filename().string() : options_.title;
    made_.the_case.card = {"Imported from " + fs::path(options_.files.front()).filename().string() + ".", "Not known.",
                           "From the entry that was chosen at import"};
    auto vessels = std::make_shared<data::ImportedVessels>();
    vessels->anatomy = made_.found.anatomy;
    if (made_.frames.empty())
      vessels->lumen = made_.found.lumen;
    else
      lay_frames(*vessels);
    made_.the_case.imported = vessels;
    try {
      made_.patient = patient_of(made_.the_case);
    } catch (const std::invalid_argument& error) {
      throw data::LoadError(error.what());
    }
    // Where vessels have their names, those of coronary arteries: others taper as they branch.
    const bool named = find_branch(made_.found.anatomy, "aorta") || find_branch(made_.found.anatomy, "LM") ||
                       find_branch(made_.found.anatomy, "RCA");
    for (const vascular::FoundNarrowing& narrowing : find_narrowings(made_.patient.tree))
      if (!named || is_coronary(made_.found.anatomy, find_branch(made_.found.anatomy, narrowing.branch)->tube))
        made_.narrowings.push_back(narrowing);
    note_what_moves_wrongly();
  }

  /// Wall without a centreline, and wall that crosses itself in the beat, which mostly is the same wall.
  void note_what_moves_wrongly() {
    const vascular::SurfaceReport systole = vascular::check_surface(made_.patient.lumen.at(vascular::end_systole, 0));
    const int crossing = systole.crossings.count;
    const vascular::Unreached rest = unreached(made_.found.lumen, made_.patient.tree);
    if (rest.share > vascular::unreached_matters) {
      const Eigen::Vector3d p = rest.p / mm;
      made_.found.notes.push_back(fmt::format(
          "{:.0f} % of the lumen's wall has no centreline, so nothing gets there, and {}: it hangs on by a narrowing "
          "finer than the grid, near {:.1f} {:.1f} {:.1f} mm of the patient frame; {}{}",
          100 * rest.share, (rest.branch.empty() ? "the vessel that leads there" : rest.branch) + " is cut short",
          p.x(), p.y(), p.z(),
          made_.frames.empty() ? "a finer --voxel may find the way"
                               : "imported alone, without --sequence, a frame is made anew on a finer grid",
          crossing > 0 ? fmt::format("; as it is, that wall moves with what lies near, and {} pairs of its triangles "
                                     "cross at end-systole",
                                     crossing)
                       : ""));
    } else if (crossing > crossing_at_rest_) {
      const Eigen::Vector3d p = systole.crossings.where.front() / mm;
      made_.found.notes.push_back(
          fmt::format("at end-systole {} pairs of triangles cross, the first at {:.1f} {:.1f} {:.1f} mm of the patient "
                      "frame: the heart's motion, laid on it, folds the wall there; --motion none leaves it still",
                      crossing, p.x(), p.y(), p.z()));
    }
  }

  /// Into the patient frame, as the files of the case will have them.
  void lay_frames(data::ImportedVessels& vessels) {
    for (vascular::Mesh& frame : made_.frames) {
      for (Eigen::Vector3d& p : frame.vertices) p = made_.found.R_PF * p - made_.found.shift_P;
      frame = as_written(std::move(frame), vascular::LengthUnit::millimetre);
    }
    made_.frames.front() = made_.found.lumen;
    set_frames(made_.frames, vessels);
  }

  const ImportArguments& options_;
  TimedProgress progress_;
  vascular::LabellingOptions wanted_;
  vascular::Mesh mesh_;
  std::vector<std::string> files_;  ///< that were read
  std::vector<std::string> doubts_of_frames_;
  double rounding_m_ = 0;     ///< between neighbouring numbers of the file
  int crossing_at_rest_ = 0;  // pairs of triangles
  Imported made_;
};

int run(const ImportArguments& arguments) { return Import(arguments).run(); }

}  // namespace

Command import_command() {
  return make_command(
      "import", "Anyone's own mesh becomes a case: mended, named, beating",
      {"ostium import aorta.stl coronaries.stl -o anna --picture anna.svg",
       "ostium import aorta.obj -o cases/aorta --units mm --entry -5,18,-11 --rename 3=coeliac",
       "ostium import heart.ply -o tight-rca --lesion RCA:40:12:75 && ostium cases tight-rca",
       "ostium import frames/ --sequence -o beating-heart", "ostium import carotid.stl -o carotid --motion none"},
      declare, run);
}

}  // namespace ostium::app
