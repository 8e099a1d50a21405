#pragma once
#include <fstream>

#include "app/commands/sweep/plan.h"

namespace ostium::app {

/// The runs already done, in a file beside the table: one line per run, flushed at once. Its first line identifies the
/// sweep. Throws LoadError.
class SweepJournal {
 public:
  SweepJournal(const std::string& file, const Sweep& sweep, bool resume);
  bool has(std::size_t task) const { return !lines_[task].empty(); }
  void add(std::size_t task, const std::string& line);
  std::size_t done() const { return done_; }
  /// Replaces the journal by the complete, sorted table.
  void finish(const std::string& table, const std::string& head);

 private:
  void read(const std::string& first);

  std::string file_;
  std::ofstream out_;
  std::vector<std::string> lines_;
  std::size_t done_ = 0;
};

}  // namespace ostium::app
