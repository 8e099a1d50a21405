#include "app/commands/sweep/sweeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <thread>

#include "app/command_line/arguments.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/path_lock.h"
#include "app/command_line/progress.h"
#include "app/commands/run/record_option.h"
#include "app/commands/sweep/table.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

std::size_t threads_for(const SweepArguments& a, std::size_t open) {
  const std::size_t jobs =
      a.jobs > 0 ? static_cast<std::size_t>(a.jobs) : std::max(1u, std::thread::hardware_concurrency());
  return std::min(jobs, open);
}

/// Parts share the folder of recordings, and a part of another sweep may be at a run of the same name. That is nothing
/// of the run: the sweep ends.
PathLock lock_of(const fs::path& folder) try {
  make_folder(folder);
  return PathLock(folder.string());
} catch (const data::LoadError& error) {
  throw data::WriteError(error.what());
}

}  // namespace

Sweeper::Sweeper(const SweepArguments& arguments, const Sweep& sweep, const JournalHead& head, SweepJournal& journal)
    : arguments_(arguments), sweep_(sweep), journal_(journal) {
  const std::vector<std::size_t> part_of = parts_of_runs(head);
  for (std::size_t run = 0; run < part_of.size(); ++run) {
    if (part_of[run] != head.part.number) continue;
    ++runs_;
    if (journal.has(run) && lacks_recording(run)) journal.forget(run);
    if (!journal.has(run)) mine_.push_back(run);
  }
}

/// What was done without --keep, or whose folder has gone, is run again.
bool Sweeper::lacks_recording(std::size_t run) const {
  return !arguments_.keep.empty() && !has_no_result(journal_.lines().at(run)) &&
         !data::is_there(fs::path(arguments_.keep) / sweep_.grid.name_of(run));
}

void Sweeper::run() {
  for (std::size_t v = 0; v < sweep_.vessels.size() && !interrupted && !problem_; ++v) {
    std::vector<std::size_t> open;
    for (const std::size_t run : mine_)
      if (sweep_.vessel_of[sweep_.grid.setting_of(run)] == v) open.push_back(run);
    if (!open.empty()) run_in(v, open);
  }
  show_progress("");
  if (problem_) std::rethrow_exception(problem_);
}

std::shared_ptr<const Vessel> Sweeper::vessel_for(const RunSetup& setup, const std::vector<std::size_t>& open) {
  show_progress("building " + setup.vessel);
  try {
    const EndsAtOnce at_once;
    std::string warnings;
    return make_vessel(setup, warnings);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    for (const std::size_t run : open) journal_.add(run, line_without_result(sweep_.grid, run, error.what()));
    show_progress("");
    fmt::print(stderr, "ostium sweep: {} cannot be built{}: {}\n", setup.vessel,
               setup.person ? fmt::format(" for person {}", *setup.person) : "", error.what());
    return nullptr;
  }
}

void Sweeper::run_in(std::size_t v, const std::vector<std::size_t>& open) {
  const auto vessel = vessel_for(sweep_.vessels[v], open);
  if (!vessel) return;
  const auto dosimeter = std::make_shared<const Dosimeter>(*vessel);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  const auto work = [&] {
    for (std::size_t i; (i = next++) < open.size() && !interrupted && !failed;) {
      try {
        const std::string line = line_for(open[i], sweep_.vessels[v], vessel, dosimeter);
        if (!interrupted) add(open[i], line);  // an interrupted run is not done
      } catch (...) {                          // nothing of the run itself: the disk, the memory
        const std::lock_guard lock(mutex_);
        problem_ = std::current_exception();
        failed = true;
      }
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t j = 0; j < threads_for(arguments_, open.size()); ++j) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
}

std::string Sweeper::line_for(std::size_t run, const RunSetup& vessel_setup,
                              const std::shared_ptr<const Vessel>& vessel,
                              const std::shared_ptr<const Dosimeter>& dosimeter) {
  PlayOptions options;
  options.recorder = recorder_of(arguments_.keep.empty() ? "none" : arguments_.record);
  const bool kept = !arguments_.keep.empty();
  const fs::path folder = kept ? fs::path(arguments_.keep) / sweep_.grid.name_of(run) : "";
  options.recorder.file = (folder / "run.h5").string();
  options.seconds = arguments_.session.seconds;
  options.dosimeter = dosimeter;
  options.stop = &interrupted;
  try {
    RunSetup setup = setup_of(sweep_, run);
    if (kept) setup.mesh = vessel_setup.mesh;  // a recording holds it
    choose_sizes(*vessel, setup);
    ScriptedRun scripted(setup, vessel);
    const PathLock lock = kept ? lock_of(folder) : PathLock();
    const PlayReport report = play(scripted, setup, options);
    if (kept && !interrupted) keep(folder.string(), setup, report);
    return line_of(sweep_.grid, run, scripted, report);
  } catch (const data::WriteError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    show_progress("");
    fmt::print(stderr, "ostium sweep: {} seed {}: {}\n", sweep_.grid.words_of(sweep_.grid.setting_of(run)),
               sweep_.grid.seed_of(run), error.what());
    return line_without_result(sweep_.grid, run, error.what());
  }
}

void Sweeper::keep(const std::string& folder, const RunSetup& setup, const PlayReport& report) {
  data::write_file((fs::path(folder) / "metrics.json").string(),
                   metrics_json(setup.vessel, setup.seed, report.outcome, report.reason, report.metrics));
  if (report.problem.empty()) return;
  const std::lock_guard lock(mutex_);
  ++unkept_;
  fmt::print(stderr, "ostium sweep: the recording in {} ends early: {}\n", folder, report.problem);
}

void Sweeper::add(std::size_t run, const std::string& line) {
  const std::lock_guard lock(mutex_);
  journal_.add(run, line);
  show_progress(fmt::format("{} of {} runs, {} seed {}", journal_.done(), runs_,
                            sweep_.grid.words_of(sweep_.grid.setting_of(run)), sweep_.grid.seed_of(run)));
}

}  // namespace ostium::app
