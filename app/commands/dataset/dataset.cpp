#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/commands/dataset/run_locks.h"
#include "app/commands/sweep/journal.h"
#include "app/session/labelling/label_set.h"
#include "app/session/labelling/labelled_run.h"
#include "app/session/labelling/splits.h"
#include "data/formats/dicom/dicom.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Arguments {
  SweepArguments runs;
  std::string folder;
  FrameOptions frames;
};

void declare(Options& options, Arguments& a) {
  options.add("vessel", a.runs.vessels, "Cases, or meshes").type("CASE|MESH").required();
  add_session_options(options, a.runs.session);
  options.add("--seeds", a.runs.seeds, "FROM..TO, or one").show_default();
  options.add("--vary", a.runs.vary, "What --set takes, with several values").type("KEY=A,B,C");
  options.add("--every", a.frames.every_s, "Seconds of simulated time between pictures")
      .range(0.05, 3600.0)
      .show_default();
  add_pixels_option(options, a.frames.pixels, 64);
  options.flag("--dicom", a.frames.dicom, "The pictures as DICOM films, too, each with a segmentation (DICOM SEG)");
  options.add("--part", a.runs.part, "Only this part of the runs; auto: by the rank that Slurm or mpirun gives")
      .type("K/N|auto");
  options.add("-o,--output", a.folder, "Where it goes; runs whose files are all there are left as they are")
      .type("DIR")
      .required();
}

class Dataset {
 public:
  Dataset(const Arguments& arguments, Sweep sweep, const SweepPart& part)
      : arguments_(arguments), sweep_(std::move(sweep)), head_(head_of(sweep_, part)), part_of_(parts_of_runs(head_)) {
    id_ = fmt::format("{} {:g} {}{}", head_.sweep, arguments.frames.every_s, arguments.frames.pixels,
                      arguments.frames.dicom ? " dicom" : "");
  }

  /// One vessel at a time, so that only one is in memory. Throws LoadError if the folder is of another set, or another
  /// program makes some of these runs.
  void run() {
    std::vector<std::size_t> own;
    for (std::size_t run = 0; run < part_of_.size(); ++run)
      if (part_of_[run] == head_.part.number) own.push_back(run);
    require_own_folder();
    locks_.emplace(file("set.txt"), id_, own);
    for (std::size_t v = 0; v < sweep_.vessels.size() && !interrupted; ++v) {
      std::shared_ptr<const Vessel> vessel;
      for (std::size_t run = 0; run < part_of_.size() && !interrupted; ++run) {
        if (part_of_[run] != head_.part.number || sweep_.vessel_of[sweep_.grid.setting_of(run)] != v) continue;
        if (is_done(run, true)) continue;
        show_progress(fmt::format("{} of {}: {}", run + 1, part_of_.size(), sweep_.grid.name_of(run)));
        make(run, vessel);
      }
    }
    show_progress("");
  }

  /// Runs of all parts that are not done.
  std::size_t missing() const {
    std::size_t count = 0;
    for (std::size_t run = 0; run < part_of_.size(); ++run) count += is_done(run, false) ? 0 : 1;
    return count;
  }

  /// Once all runs are done. Returns the number of pictures; says why, if there is none.
  std::size_t finish() const {
    locks_->keep_others_from_finishing();
    std::vector<Json> runs;
    double longest_s = 0;
    for (std::size_t run = 0; run < part_of_.size(); ++run) {
      runs.push_back(stored(run));
      longest_s = std::max(longest_s, runs.back().value("simulated_s", 0.0));
    }
    const std::size_t pictures = write_label_set(
        arguments_.folder, {arguments_.frames.every_s, arguments_.frames.pixels, sweep_.grid.keys}, runs);
    if (pictures == 0)
      fmt::print(stderr, "{}\n",
                 longest_s == 0 ? "no run could be made"
                 : longest_s < first_picture_s(arguments_.frames)
                     ? fmt::format("all runs ended before the first picture, the longest after {:.3g} s; expected a "
                                   "smaller --every",
                                   longest_s)
                     : "no tool was in the body when a picture was due");
    return pictures;
  }

 private:
  /// Throws LoadError where somebody else's lists would be replaced.
  void require_own_folder() const {
    if (data::is_there(file("set.txt"))) return;
    for (const char* name : label_set_files)
      if (data::is_there(file(name)))
        throw data::LoadError(file(name) +
                              ": is there, and of no set of pictures of ostium; expected a folder of its own");
  }

  std::string file(const std::string& name) const { return (fs::path(arguments_.folder) / name).string(); }
  std::string run_file(std::size_t run) const { return file("runs/" + sweep_.grid.name_of(run) + ".json"); }

  Json stored(std::size_t run) const {
    try {
      Json out = Json::parse(data::read_file(run_file(run), "a run's list of pictures"));
      if (out.at("dataset") == id_) return out;
    } catch (const Json::exception&) {
    }
    throw data::LoadError(
        fmt::format("{}: is of another set of pictures, or damaged; remove it, or name another folder", run_file(run)));
  }

  bool is_done(std::size_t run, bool says) const {
    if (!data::is_there(run_file(run))) return false;
    const std::string lost = lost_file(stored(run), arguments_.folder);
    if (says && !lost.empty()) fmt::print(stderr, "{}: is gone, or was cut short; its run is made again\n", file(lost));
    return lost.empty();
  }

  /// A run that throws is one without pictures, with its reason.
  void make(std::size_t run, std::shared_ptr<const Vessel>& vessel) const {
    const RunSetup& built = sweep_.vessels[sweep_.vessel_of[sweep_.grid.setting_of(run)]];
    Json out = {{"dataset", id_},
                {"name", sweep_.grid.name_of(run)},
                {"case", sweep_.grid.case_of(sweep_.grid.setting_of(run))},
                {"script", sweep_.grid.script},
                {"seed", sweep_.grid.seed_of(run)},
                {"values", sweep_.grid.values_of(sweep_.grid.setting_of(run))},
                {"person", person_of(built)}};
    try {
      if (!vessel) {
        const EndsAtOnce at_once;
        std::string warnings;
        vessel = make_vessel(built, warnings);
      }
      RunSetup setup = setup_of(sweep_, run);
      choose_sizes(*vessel, setup);
      FrameOptions options = arguments_.frames;
      options.seconds = arguments_.runs.session.seconds;
      options.stop = [] { return interrupted.load(); };
      const Json made = frames_of_run(setup, vessel, sweep_.grid.name_of(run), arguments_.folder, options);
      if (made.empty()) return;
      out.update(made);
    } catch (const data::WriteError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      show_progress("");
      fmt::print(stderr, "ostium dataset: {}: {}\n", sweep_.grid.name_of(run), error.what());
      out.update(
          Json({{"outcome", "aborted"}, {"reason", error.what()}, {"simulated_s", 0}, {"pictures", Json::array()}}));
    }
    data::write_file(run_file(run), out.dump() + "\n");
  }

  const Arguments& arguments_;
  const Sweep sweep_;
  const JournalHead head_;
  const std::vector<std::size_t> part_of_;
  std::string id_;
  std::optional<RunLocks> locks_;
};

/// Exit code: 0 if every run of this part is done.
int run(const Arguments& a) {
  if (a.frames.dicom) data::require_dicom();
  if (const double s = a.runs.session.seconds; s > 0 && s <= first_picture_s(a.frames))
    throw data::LoadError(
        fmt::format("--seconds {:g} is over before the first picture is due, at {:.3g} s (--every); "
                    "expected more seconds, or a smaller --every",
                    s, first_picture_s(a.frames)));
  const SweepPart part = part_from(a.runs.part);
  Dataset dataset(a, plan_sweep(a.runs), part);
  for (const char* folder : {"images", "masks", "depth", "runs"}) make_folder(fs::path(a.folder) / folder);
  stop_on_signals();
  dataset.run();
  const std::size_t missing = dataset.missing();
  if (interrupted || missing > 0) {
    fmt::print("{}: {} runs are not done; the same command goes on\n", a.folder, missing);
    return interrupted ? 1 : 0;
  }
  const std::size_t pictures = dataset.finish();
  fmt::print("{}: {} pictures\n", a.folder, pictures);
  return pictures == 0 ? 1 : 0;
}

}  // namespace

Command dataset_command() {
  return make_command(
      "dataset", "Labelled pictures of a script's runs: COCO, masks, key points, centrelines, C-arm",
      {"ostium dataset rca-mid-focal --script pci-rca-mid-focal --vary person=0,1,2,3 --seeds 1..3 -o set",
       "ostium dataset rca-mid-focal lcx-tubular --every 0.2 --pixels 256 --part 1/4 -o set"},
      declare, run);
}

}  // namespace ostium::app
