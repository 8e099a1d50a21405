#include <fmt/format.h>

#include <filesystem>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/path_lock.h"
#include "app/commands/run/record_option.h"
#include "app/commands/sweep/merge.h"
#include "app/commands/sweep/sweeper.h"
#include "app/commands/sweep/table.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

void declare(Options& options, SweepArguments& a) {
  options.add("vessel", a.vessels, "Cases, or meshes").type("CASE|MESH");
  add_session_options(options, a.session);
  options.add("--seeds", a.seeds, "FROM..TO, or one").show_default();
  options.add("--vary", a.vary, "What --set takes, with several values").type("KEY=A,B,C");
  options.add("--jobs", a.jobs, "Runs at the same time; 0: one for each core").range(0, 1024);
  options.flag("--resume", a.resume, "Go on with a table that was not finished");
  options.add("-o,--output", a.table, "The table").type("TABLE.csv").writes();
  options.add("--part", a.part, "Only this part of it; auto: by the rank that Slurm or mpirun gives").type("K/N|auto");
  options.add("--merge", a.merge, "Put the parts of this table together").type("TABLE.csv");
  options.add("--keep", a.keep, "Where the recording of each run goes").type("DIR");
  options.add("--record", a.record, record_help()).type(record_words());
  options.exclude("--merge", {"--seeds", "--vary", "--jobs", "--resume", "--keep", "--record", "--set", "--script"});
}

void require_arguments(const SweepArguments& a) {
  if (!a.merge.empty()) {
    if (!a.vessels.empty() || !a.table.empty() || !a.part.empty())
      throw data::LoadError("--merge TABLE.csv stands alone: its parts know what they are of");
    return;
  }
  if (a.vessels.empty()) throw data::LoadError("there is nothing to run; expected cases or meshes");
  if (a.table.empty()) throw data::LoadError("there is no table; expected -o TABLE.csv");
  if (!a.keep.empty() &&
      std::filesystem::absolute(a.keep).lexically_normal() == std::filesystem::absolute(a.table).lexically_normal())
    throw data::LoadError(fmt::format("--keep {} is the table, too; expected another folder", a.keep));
  recorder_of(a.record);
  if (a.keep.empty() && !a.record.empty() && a.record != "none")
    throw data::LoadError("--record " + a.record + " has no place; expected --keep DIR");
}

/// Of a part: its runs stay in its file, which --merge reads.
int end_of(const SweepArguments& a, const SweepPart& part, SweepJournal& journal, const Sweeper& sweeper) {
  if (part.is_all) {
    try {
      write_table(a.table, heading(sweeper.sweep().grid), journal.lines());
    } catch (const data::LoadError&) {
      journal.remove();
      throw;
    }
    journal.remove();
    fmt::print("{}: {} runs\n", a.table, journal.done());
  } else {
    fmt::print("{}: {} runs; `ostium sweep --merge {}` once all parts are done\n", part_file(a.table, part),
               journal.done(), a.table);
  }
  if (sweeper.unkept() == 0) return 0;
  fmt::print(stderr, "ostium sweep: {} recordings end early\n", sweeper.unkept());
  return 1;
}

/// Exit code: 0 if every run ended, whatever its outcome.
int run(const SweepArguments& a) {
  require_arguments(a);
  if (!a.merge.empty()) return merge_parts(a.merge);
  const SweepPart part = part_from(a.part);
  const Sweep sweep = plan_sweep(a);
  const JournalHead head = head_of(sweep, part);
  if (!a.keep.empty()) make_folder(a.keep);
  const PathLock lock = a.keep.empty() ? PathLock() : PathLock(a.keep, /*shared=*/!part.is_all);
  SweepJournal journal(part_file(a.table, part), a.table, head, a.resume);
  stop_on_signals();
  Sweeper sweeper(a, sweep, head, journal);
  sweeper.run();
  if (!interrupted) return end_of(a, part, journal, sweeper);
  fmt::print(stderr, "ostium sweep: stopped after {} of {} runs{}\n", journal.done(), sweeper.runs(),
             has_journal(a.table) ? "; --resume goes on" : "");
  return 1;
}

}  // namespace

Command sweep_command() {
  return make_command(
      "sweep", "A script many times: cases, seeds, parameters; one table",
      {"ostium sweep rca-mid-focal --seeds 1..100 -o table.csv",
       ("ostium sweep rca-mid-focal lcx-tubular --vary wire=cook-j,rosen,bentson --vary person=0,1,2 "
        "--seeds 1..10 -o table.csv"),
       "ostium sweep rca-mid-focal --vary person=0,1,2,3 --part 1/4 -o table.csv", "ostium sweep --merge table.csv",
       "ostium sweep rca-mid-focal --seeds 1..20 -o table.csv --keep runs --record full"},
      declare, run);
}

}  // namespace ostium::app
