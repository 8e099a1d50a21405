#pragma once
/// The runs already done, in a file beside the table: one line per run, flushed at once. Its first line says which part
/// of which sweep it is.
#include <fstream>
#include <map>
#include <optional>

#include "app/command_line/path_lock.h"
#include "app/commands/sweep/part.h"
#include "app/commands/sweep/plan.h"

namespace ostium::app {

struct JournalHead {
  std::string sweep;  ///< a number made of everything that is run
  SweepPart part;
  std::string heading;  ///< of the table
  SweepGrid grid;
  std::vector<std::size_t> vessel_of;  ///< of each setting of the grid
};

/// By part, from 1, of each run.
std::vector<std::size_t> parts_of_runs(const JournalHead& head);

struct StoredJournal {
  JournalHead head;
  std::string first;                         ///< its first line
  std::map<std::size_t, std::string> lines;  ///< by run
};
/// Throws LoadError if it is none. A last line that was cut off is left out.
StoredJournal read_journal(const std::string& file);

/// Nothing is kept beside a device or a pipe: what they get is written to them at the end.
bool has_journal(const std::string& table);

class SweepJournal {
 public:
  /// Throws LoadError if the file is of another sweep, of this one without `resume`, or written by another program, or
  /// if `resume` finds a table and nothing to go on with; WriteError.
  SweepJournal(const std::string& file, const std::string& table, const JournalHead& head, bool resume);
  bool has(std::size_t run) const { return lines_.count(run) > 0; }
  /// As if it was not done.
  void forget(std::size_t run) { lines_.erase(run); }
  /// Throws WriteError.
  void add(std::size_t run, const std::string& line);
  std::size_t done() const { return lines_.size(); }
  const std::map<std::size_t, std::string>& lines() const { return lines_; }
  void remove();

 private:
  std::string file_;
  std::ofstream out_;
  std::optional<PathLock> lock_;
  std::map<std::size_t, std::string> lines_;
};

JournalHead head_of(const Sweep& sweep, const SweepPart& part);

/// Writes the table from the lines of all its runs. Throws WriteError; LoadError if none of them has a result.
void write_table(const std::string& table, const std::string& head, const std::map<std::size_t, std::string>& lines);

}  // namespace ostium::app
