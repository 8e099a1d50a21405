#include "app/command_line/templates.h"

#include <algorithm>
#include <filesystem>

#include "app/command_line/arguments.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

fs::path templates_folder() { return fs::path(data::data_folder()) / "templates"; }

}  // namespace

std::vector<std::string> template_kinds() {
  std::vector<std::string> kinds;
  for (const fs::directory_entry& entry : fs::directory_iterator(templates_folder()))
    if (entry.is_directory()) kinds.push_back(entry.path().filename().string());
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

std::vector<std::string> write_template(const std::string& kind, const std::string& folder) {
  const std::vector<std::string> kinds = template_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    std::string known;
    for (const std::string& k : kinds) known += (known.empty() ? "" : ", ") + k;
    throw data::LoadError("there is no template of \"" + kind + "\"; there are " + known);
  }
  return write_template_of("templates/" + kind, folder);
}

std::vector<std::string> write_template_of(const std::string& below_data, const std::string& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(data::data_folder()) / below_data))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> written;
  for (const fs::path& file : files) {
    written.push_back((fs::path(folder) / file.filename()).string());
    if (data::is_there(written.back()))
      throw data::LoadError(written.back() + " is there already; expected a folder without it");
  }
  make_folder(folder);
  for (std::size_t i = 0; i < files.size(); ++i) data::write_file(written[i], data::read_file(files[i].string()));
  return written;
}

}  // namespace ostium::app
