#include "app/command_line/filled_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "app/command_line/arguments.h"
#include "app/command_line/interrupt.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace fs = std::filesystem;

namespace {

/// The folders of a path that are not there yet, the innermost first.
std::vector<fs::path> missing(const std::string& path) {
  std::vector<fs::path> out;
  std::error_code none;
  if (path.empty()) return out;
  for (fs::path at = fs::absolute(path).lexically_normal(); !at.empty() && !fs::exists(at, none); at = at.parent_path())
    if (at.has_filename()) out.push_back(at);
  return out;
}

PathLock lock_of(const std::string& path) {
  if (path.empty()) return {};
  make_folder(path);
  if (access(path.c_str(), W_OK | X_OK) != 0) throw data::write_error(path, std::strerror(errno));
  return PathLock(path);
}

}  // namespace

FilledFolder::FilledFolder(const std::string& path) : made_(missing(path)), lock_(lock_of(path)) {
  leave_no_empty(made_);
}

FilledFolder::~FilledFolder() {
  std::error_code none;
  for (const fs::path& folder : made_)
    if (!fs::is_empty(folder, none) || none || !fs::remove(folder, none)) return;
}

}  // namespace ostium::app
