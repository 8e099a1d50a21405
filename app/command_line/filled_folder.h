#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/command_line/path_lock.h"

namespace ostium::app {

/// A folder that a command fills: made if there is none, one program's at a time, and gone in the end if nothing was
/// written into it, so that a command that refuses its input leaves nothing behind.
class FilledFolder {
 public:
  /// "": none is asked for. Throws WriteError if it cannot be made, LoadError if another program has it.
  explicit FilledFolder(const std::string& path);
  FilledFolder(const FilledFolder&) = delete;
  FilledFolder& operator=(const FilledFolder&) = delete;
  ~FilledFolder();

 private:
  std::vector<std::filesystem::path> made_;  ///< by this, the innermost first
  PathLock lock_;
};

}  // namespace ostium::app
