#include "app/commands/sweep/merge.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/commands/sweep/journal.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

/// Whether a file's name ends as that of a part: "2-of-8".
bool is_part(const std::string& end) {
  const std::size_t of = end.find("-of-");
  return of != std::string::npos && data::whole(end.substr(0, of)) && data::whole(end.substr(of + 4));
}

/// By their numbers.
std::map<std::size_t, StoredJournal> parts_beside(const std::string& table) {
  const fs::path path(table), folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string beginning = path.filename().string() + ".part-";
  std::map<std::size_t, StoredJournal> parts;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(beginning) || !is_part(name.substr(beginning.size()))) continue;
    StoredJournal part = read_journal(entry.path().string());
    const SweepPart own = part.head.part;
    const auto& first = parts.empty() ? part.head : parts.begin()->second.head;
    if (first.sweep != part.head.sweep || first.part.of != own.of)
      throw data::LoadError(fmt::format("{} and {} are not of one sweep in {} parts; remove what is old",
                                        entry.path().string(), part_file(table, first.part), own.of));
    if (!parts.try_emplace(own.number, std::move(part)).second)
      throw data::LoadError(fmt::format("{} is there twice, under another name; remove one", part_file(table, own)));
  }
  if (parts.empty())
    throw data::LoadError(fmt::format(
        "{} has no parts beside it ({}-K-of-N); expected what `ostium sweep --part` wrote", table, table + ".part"));
  return parts;
}

/// "seeds 1 to 4, 7"
std::string words_for(const std::vector<std::uint64_t>& seeds) {
  std::string words = seeds.size() == 1 ? "seed " : "seeds ";
  for (std::size_t i = 0; i < seeds.size();) {
    std::size_t last = i;
    while (last + 1 < seeds.size() && seeds[last + 1] == seeds[last] + 1) ++last;
    if (i > 0) words += ", ";
    words += last == i ? fmt::format("{}", seeds[i]) : fmt::format("{} to {}", seeds[i], seeds[last]);
    i = last + 1;
  }
  return words;
}

/// The missing runs of one part, at most so many settings of them.
std::string words_for(const SweepGrid& grid, const std::vector<std::size_t>& runs) {
  constexpr std::size_t most = 10;
  std::string words;
  std::size_t settings = 0;
  for (std::size_t i = 0; i < runs.size(); ++settings) {
    const std::size_t setting = grid.setting_of(runs[i]);
    std::vector<std::uint64_t> seeds;
    for (; i < runs.size() && grid.setting_of(runs[i]) == setting; ++i) seeds.push_back(grid.seed_of(runs[i]));
    if (settings < most) words += fmt::format("  {}: {}\n", grid.words_of(setting), words_for(seeds));
  }
  if (settings > most) words += fmt::format("  and {} settings more\n", settings - most);
  return words;
}

}  // namespace

int merge_parts(const std::string& table) {
  const auto parts = parts_beside(table);
  const JournalHead& head = parts.begin()->second.head;
  std::map<std::size_t, std::string> lines;
  for (const auto& [number, part] : parts) lines.insert(part.lines.begin(), part.lines.end());
  const std::size_t runs = head.grid.runs();
  if (lines.size() == runs) {
    write_table(table, head.heading, lines);
    fmt::print("{}: {} runs of {} parts\n", table, runs, parts.size());
    return 0;
  }
  fmt::print(stderr, "ostium sweep: {} of {} runs are missing, and {} was not written\n", runs - lines.size(), runs,
             table);
  std::map<std::size_t, std::vector<std::size_t>> missing;  // by part
  const std::vector<std::size_t> part_of = parts_of_runs(head);
  for (std::size_t run = 0; run < runs; ++run)
    if (lines.count(run) == 0) missing[part_of[run]].push_back(run);
  for (const auto& [number, own] : missing)
    fmt::print(stderr, "part {}/{} {}; missing:\n{}", number, head.part.of,
               parts.count(number) ? "is not finished" : "was not begun", words_for(head.grid, own));
  fmt::print(stderr, "The same command with --part K/{} --resume runs what a part lacks.\n", head.part.of);
  return 1;
}

}  // namespace ostium::app
