#include "app/command_line/passing_folder.h"

#include <cstdlib>
#include <filesystem>

#include "data/formats/load_error.h"

namespace ostium::app {

namespace fs = std::filesystem;

PassingFolder::PassingFolder(const std::string& command) {
  std::error_code none;
  std::string name = (fs::temp_directory_path(none) / ("ostium-" + command + "-XXXXXX")).string();
  if (none || !mkdtemp(name.data()))
    throw data::LoadError("no folder for what passes can be made, in TMPDIR or /tmp; make room there");
  path_ = name;
}

PassingFolder::~PassingFolder() {
  std::error_code none;
  fs::remove_all(path_, none);
}

}  // namespace ostium::app
