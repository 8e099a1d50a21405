#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/commands/sweep/journal.h"
#include "app/commands/sweep/table.h"
#include "data/formats/load_error.h"
#include "tests/fuzz/target.h"

namespace ostium::fuzz {

namespace {

/// An unfinished table: four runs of part 2 of 3, or those of a sweep in one process.
std::string journal(const app::SweepPart& part) {
  const app::SweepGrid grid{.cases = {"rca-mid-focal", "lcx-tubular"},
                            .script = "iliac-wire",
                            .keys = {"wire"},
                            .values = {{"cook-j", "rosen", "bentson"}},
                            .first_seed = 1,
                            .last_seed = 4};
  const app::JournalHead head{.sweep = "0123456789abcdef",
                              .part = part,
                              .heading = app::heading(grid),
                              .grid = grid,
                              .vessel_of = {0, 0, 0, 1, 1, 1}};
  const InputFile file({"journal", ""});
  {
    std::filesystem::remove(file.path());
    app::SweepJournal written(file.path(), file.path() + ".csv", head, false);
    for (const std::size_t run : {0U, 3U, 12U, 23U}) written.add(run, app::line_without_result(grid, run, "no room"));
  }
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<Seed> journals() {
  return {{"table.csv.part-2-of-3", journal({2, 3, false})}, {"table.csv.part", journal({})}};
}

/// What is taken can be merged: each line is of a run of the sweep, and each run of a part.
Answer read_part(const Seed& input) {
  const InputFile file(input);
  return answer_of<data::LoadError>([&] {
    const app::StoredJournal stored = app::read_journal(file.path());
    const std::vector<std::size_t> part_of = parts_of_runs(stored.head);
    require(part_of.size() == stored.head.grid.runs(), "each run is of a part");
    for (const std::size_t part : part_of) require(part >= 1 && part <= stored.head.part.of, "a part is one of them");
    for (const auto& [run, line] : stored.lines) {
      require(run < part_of.size() && line.ends_with('\n'), "a line is of a run");
      stored.head.grid.words_of(stored.head.grid.setting_of(run));
    }
  });
}

}  // namespace

std::vector<Target> sweep_targets() { return {{"sweep", journals, read_part}}; }

}  // namespace ostium::fuzz
