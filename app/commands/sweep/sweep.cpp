#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <thread>

#include "app/command_line/command.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/progress.h"
#include "app/commands/sweep/journal.h"
#include "app/commands/sweep/table.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

void declare(Options& options, SweepArguments& a) {
  options.add("vessel", a.vessels, "Cases, or meshes").type("CASE|MESH").required();
  add_session_options(options, a.session);
  options.add("--seeds", a.seeds, "FROM..TO, or one").show_default();
  options.add("--vary", a.vary, "What --set takes, with several values").type("KEY=A,B,C");
  options.add("--jobs", a.jobs, "Runs at the same time; 0: one for each core").range(0, 1024);
  options.flag("--resume", a.resume, "Go on with a table that was not finished");
  options.add("-o,--output", a.table, "The table").type("TABLE.csv").required();
}

/// Runs the remaining runs of a sweep on several threads.
class Sweeper {
 public:
  Sweeper(const SweepArguments& arguments, const Sweep& sweep, SweepJournal& journal)
      : arguments_(arguments), sweep_(sweep), journal_(journal) {}

  /// One vessel at a time, so that only one is in memory.
  void run() {
    for (std::size_t v = 0; v < sweep_.vessels.size() && !interrupted && problem_.empty(); ++v) {
      std::vector<std::size_t> open;
      for (std::size_t t = 0; t < sweep_.tasks.size(); ++t)
        if (sweep_.tasks[t].vessel == v && !journal_.has(t)) open.push_back(t);
      if (open.empty()) continue;
      if (const auto vessel = vessel_for(sweep_.vessels[v], open)) run_in(vessel, open);
    }
    show_progress("");
  }

  std::size_t refused() const { return refused_; }         ///< runs whose vessel cannot be built
  const std::string& problem() const { return problem_; }  ///< why the sweep ended early

 private:
  /// Null if it cannot be built; its runs are then reported as aborted.
  std::shared_ptr<const Vessel> vessel_for(const RunSetup& setup, const std::vector<std::size_t>& open) {
    show_progress("building " + setup.vessel);
    try {
      std::string warnings;
      return make_vessel(setup, warnings);
    } catch (const std::exception& error) {
      for (const std::size_t t : open) journal_.add(t, line_without_vessel(sweep_.tasks[t], error.what()));
      refused_ += open.size();
      show_progress("");
      fmt::print(stderr, "ostium sweep: {} cannot be built{}: {}\n", setup.vessel,
                 setup.person ? fmt::format(" for person {}", *setup.person) : "", error.what());
      return nullptr;
    }
  }

  void run_in(const std::shared_ptr<const Vessel>& vessel, const std::vector<std::size_t>& open) {
    const auto dosimeter = std::make_shared<const Dosimeter>(*vessel);
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i; (i = next++) < open.size() && !interrupted;) {
        try {
          run_task(open[i], vessel, dosimeter);
        } catch (const std::exception& error) {
          const std::lock_guard lock(mutex_);
          problem_ = error.what();
          interrupted = true;
        }
      }
    };
    const std::size_t jobs = arguments_.jobs > 0 ? static_cast<std::size_t>(arguments_.jobs)
                                                 : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::thread> threads;
    for (std::size_t j = 0; j < std::min(jobs, open.size()); ++j) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
  }

  void run_task(std::size_t t, const std::shared_ptr<const Vessel>& vessel,
                const std::shared_ptr<const Dosimeter>& dosimeter) {
    const SweepTask& task = sweep_.tasks[t];
    RunSetup setup = task.setup;
    choose_sizes(*vessel, setup);
    ScriptedRun run(setup, vessel);
    PlayOptions options;
    options.recorder.mode = RecordMode::none;
    options.seconds = arguments_.session.seconds;
    options.dosimeter = dosimeter;
    options.stop = &interrupted;
    const PlayReport report = play(run, setup, options);
    if (interrupted) return;  // the run was interrupted: do not record it as done
    const std::lock_guard lock(mutex_);
    journal_.add(t, line_of(task, run, report));
    show_progress(fmt::format("{} of {} runs, {} seed {}: {}", journal_.done(), sweep_.tasks.size(), task.setup.vessel,
                              task.seed, report.outcome));
  }

  const SweepArguments& arguments_;
  const Sweep& sweep_;
  SweepJournal& journal_;
  std::mutex mutex_;
  std::string problem_;
  std::size_t refused_ = 0;
};

/// Exit code: 0 if every run ended, whatever its outcome.
int run(const SweepArguments& a) {
  const Sweep sweep = plan_sweep(a);
  const std::string unfinished = a.table + ".part";
  SweepJournal journal(unfinished, sweep, a.resume);
  stop_on_signals();
  Sweeper sweeper(a, sweep, journal);
  sweeper.run();
  if (sweeper.refused() == sweep.tasks.size()) {
    std::filesystem::remove(unfinished);
    throw data::LoadError("no vessel of the sweep can be built");
  }
  if (!sweeper.problem().empty()) throw data::LoadError(sweeper.problem());
  if (interrupted) {
    fmt::print(stderr, "ostium sweep: stopped after {} of {} runs; --resume goes on\n", journal.done(),
               sweep.tasks.size());
    return 1;
  }
  journal.finish(a.table, heading(sweep));
  fmt::print("{}: {} runs\n", a.table, sweep.tasks.size());
  return 0;
}

}  // namespace

Command sweep_command() {
  return make_command("sweep", "A script many times: cases, seeds, parameters; one table",
                      {"ostium sweep rca-mid-focal --seeds 1..100 -o table.csv",
                       "ostium sweep rca-mid-focal lcx-tubular --vary wire=cook-j,rosen,bentson --vary person=0,1,2 "
                       "--seeds 1..10 -o table.csv"},
                      declare, run);
}

}  // namespace ostium::app
