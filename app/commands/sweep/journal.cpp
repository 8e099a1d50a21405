#include "app/commands/sweep/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands/sweep/table.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace fs = std::filesystem;

namespace {

const std::string schema = "ostium-sweep-part/1";
constexpr std::size_t most_bytes = std::size_t{1} << 34;  // a line a run

std::string to_line(const JournalHead& head) {
  return nlohmann::ordered_json({{"schema", schema},
                                 {"sweep", head.sweep},
                                 {"part", {head.part.number, head.part.of}},
                                 {"heading", head.heading},
                                 {"grid", to_json(head.grid)},
                                 {"vessel_of", head.vessel_of}})
      .dump();
}

JournalHead head_from(const std::string& file, const std::string& line) {
  try {
    const auto in = nlohmann::ordered_json::parse(line);
    if (in.at("schema") != schema) throw data::LoadError("another schema");
    JournalHead head{.sweep = in.at("sweep"),
                     .part = {in.at("part").at(0), in.at("part").at(1), false},
                     .heading = in.at("heading"),
                     .grid = grid_from_json(in.at("grid")),
                     .vessel_of = in.at("vessel_of")};
    const auto beyond = [&](std::size_t vessel) { return vessel >= head.vessel_of.size(); };
    if (head.vessel_of.size() != head.grid.settings() || head.part.number < 1 || head.part.number > head.part.of ||
        head.part.of > most_parts || std::any_of(head.vessel_of.begin(), head.vessel_of.end(), beyond))
      throw data::LoadError("its numbers contradict each other");
    return head;
  } catch (const nlohmann::json::exception&) {
    throw data::LoadError(file + ": is no unfinished table of `ostium sweep`, or its first line is damaged; remove it");
  } catch (const std::exception& error) {
    throw data::LoadError(
        fmt::format("{}: is no unfinished table of `ostium sweep` ({}); remove it", file, error.what()));
  }
}

}  // namespace

std::vector<std::size_t> parts_of_runs(const JournalHead& head) {
  std::vector<std::size_t> vessel_of_run(head.grid.runs());
  for (std::size_t run = 0; run < vessel_of_run.size(); ++run)
    vessel_of_run[run] = head.vessel_of[head.grid.setting_of(run)];
  const std::size_t vessels = *std::max_element(head.vessel_of.begin(), head.vessel_of.end()) + 1;
  return parts_of_runs(vessel_of_run, vessels, head.part.of);
}

JournalHead head_of(const Sweep& sweep, const SweepPart& part) {
  JournalHead head{
      .sweep = "", .part = part, .heading = heading(sweep.grid), .grid = sweep.grid, .vessel_of = sweep.vessel_of};
  std::string what = OSTIUM_VERSION + head.heading + to_json(sweep.grid).dump();
  for (const RunSetup& setup : sweep.settings) what += to_json(setup);
  what += fmt::format(" {}", sweep.seconds);
  head.sweep = fmt::format("{:016x}", std::hash<std::string>{}(what));
  return head;
}

StoredJournal read_journal(const std::string& file) {
  std::istringstream in(data::read_file(file, "an unfinished table of `ostium sweep`", most_bytes));
  StoredJournal out;
  std::getline(in, out.first);
  out.head = head_from(file, out.first);
  const std::size_t runs = out.head.grid.runs();
  // A last line without a line end was cut off when the program was killed.
  for (std::string line; std::getline(in, line) && !in.eof();) {
    std::size_t run = 0;
    const char* const last = line.data() + line.size();
    const auto [end, problem] = std::from_chars(line.data(), last, run);
    if (problem != std::errc() || run >= runs || end == last || *end != ' ')
      throw data::LoadError(file + " is damaged; remove it, and the sweep begins anew");
    std::string own(end + 1, last);
    if (own.ends_with('\r')) own.pop_back();  // of an editor
    if (!is_line_of(out.head.grid, run, own))
      throw data::LoadError(fmt::format(
          "{}: the line of run {} is of another case, script, seed or value, or has another number of columns; remove "
          "it, and --resume makes the run again",
          file, run));
    out.lines[run] = own + "\n";
  }
  return out;
}

bool has_journal(const std::string& table) {
  return fs::path(table).parent_path() != "/dev" && (!data::is_there(table) || data::is_file(table));
}

SweepJournal::SweepJournal(const std::string& file, const std::string& table, const JournalHead& head, bool resume)
    : file_(has_journal(table) ? file : "") {
  if (file_.empty()) {
    if (head.part.is_all && !resume) return;
    throw data::LoadError(table + " is no file, and keeps nothing; expected a file with --part or --resume");
  }
  const std::string first = to_line(head);
  std::string kept = first + "\n";
  if (data::is_there(file)) {
    data::require_file(file, "an unfinished table, or nothing");
    lock_.emplace(file);
    if (!resume)
      throw data::LoadError(
          fmt::format("{} is of a sweep that was not finished; --resume goes on with it, or remove it", file));
    StoredJournal stored = read_journal(file);
    if (stored.first != first)
      throw data::LoadError(
          fmt::format("{} is of another sweep; expected the same ostium, cases, meshes, script, "
                      "seeds, --seconds and parameters",
                      file));
    lines_ = std::move(stored.lines);
    for (const auto& [run, line] : lines_) kept += fmt::format("{} {}", run, line);
  } else if (resume && data::is_there(table)) {
    throw data::LoadError(fmt::format(
        "{} is there, and no {} to go on with: it is finished, or another table; without --resume it is made anew",
        table, file));
  }
  data::write_file(file, kept);  // without what was cut off
  out_.open(file, std::ios::app | std::ios::binary);
  if (!out_) throw data::write_error(file);
  lock_.emplace(file);  // of the file that is there now
}

void SweepJournal::add(std::size_t run, const std::string& line) {
  lines_[run] = line;
  if (file_.empty()) return;
  out_ << run << " " << line << std::flush;
  if (!out_) throw data::write_error(file_);
}

void SweepJournal::remove() {
  out_.close();
  if (!file_.empty()) std::remove(file_.c_str());
}

void write_table(const std::string& table, const std::string& head, const std::map<std::size_t, std::string>& lines) {
  const auto nothing = [](const auto& line) { return has_no_result(line.second); };
  if (std::all_of(lines.begin(), lines.end(), nothing))
    throw data::LoadError("no run of the sweep can be made; the first: " + without_end(lines.begin()->second));
  std::string text = head;
  for (const auto& [run, line] : lines) text += line;
  data::write_file(table, text);
}

}  // namespace ostium::app
