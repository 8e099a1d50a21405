#include "app/commands/sweep/journal.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>

#include "app/commands/sweep/table.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace fs = std::filesystem;

SweepJournal::SweepJournal(const std::string& file, const Sweep& sweep, bool resume)
    : file_(file), lines_(sweep.tasks.size()) {
  std::string what = heading(sweep);
  for (const SweepTask& task : sweep.tasks) what += to_json(task.setup);
  const std::string first =
      fmt::format("sweep of {} runs, {:016x}", sweep.tasks.size(), std::hash<std::string>{}(what));
  if (fs::exists(file)) {
    if (!resume)
      throw data::LoadError(
          fmt::format("{} is of a sweep that was not finished; --resume goes on with it, or remove it", file));
    read(first);
  }
  std::error_code none;
  if (fs::path(file).has_parent_path()) fs::create_directories(fs::path(file).parent_path(), none);
  out_.open(file, std::ios::app | std::ios::binary);
  if (!out_) throw data::write_error(file);
  if (done_ == 0 && fs::file_size(file) == 0) out_ << first << "\n";
  out_.flush();
  if (!out_) throw data::write_error(file);
}

void SweepJournal::add(std::size_t task, const std::string& line) {
  lines_[task] = line;
  ++done_;
  out_ << task << " " << line << std::flush;
  if (!out_) throw data::write_error(file_);
}

void SweepJournal::finish(const std::string& table, const std::string& head) {
  std::string text = head;
  for (const std::string& line : lines_) text += line;
  data::write_file(table, text);
  out_.close();
  std::remove(file_.c_str());
}

void SweepJournal::read(const std::string& first) {
  std::ifstream in(file_, std::ios::binary);
  std::string line, kept;
  std::getline(in, line);
  if (line != first)
    throw data::LoadError(
        fmt::format("{} is of another sweep; expected the same cases, script, seeds and parameters", file_));
  kept = line + "\n";
  // A last line without a line end was cut off when the program was killed.
  while (std::getline(in, line) && !in.eof()) {
    std::size_t task = 0;
    const char* const last = line.data() + line.size();
    const auto [end, problem] = std::from_chars(line.data(), last, task);
    if (problem != std::errc() || task >= lines_.size() || end == last || *end != ' ')
      throw data::LoadError(file_ + " is damaged; remove it, and the sweep begins anew");
    if (lines_[task].empty()) ++done_;
    lines_[task] = std::string(end + 1, last) + "\n";
    kept += line + "\n";
  }
  in.close();
  data::write_file(file_, kept);
}

}  // namespace ostium::app
