#include "data/catalogue/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace fs = std::filesystem;

namespace {

std::string folder_set;  // empty: none was

}  // namespace

void set_data_folder(const std::string& folder) { folder_set = folder; }

std::string data_folder() {
  if (!folder_set.empty()) return folder_set;
  if (const char* set = std::getenv("OSTIUM_DATA"); set && *set) {
    if (!is_folder(set))
      throw LoadError(fmt::format("OSTIUM_DATA is \"{}\"; expected the folder that holds instruments/", set));
    return set;
  }
  std::error_code no_proc;
  const fs::path program = fs::read_symlink("/proc/self/exe", no_proc);
  const fs::path installed = program.parent_path().parent_path() / "share" / "ostium";
  if (!no_proc && is_folder(installed)) return installed.string();
  if (is_folder(OSTIUM_SOURCE_DATA)) return OSTIUM_SOURCE_DATA;
  throw LoadError(
      fmt::format("there is no data at {}; set OSTIUM_DATA to the folder that holds instruments/", installed.string()));
}

std::vector<Instrument> load_catalogue(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty())
    throw LoadError(folder + ": has no instrument file; expected a folder with at least one NAME.json");
  std::sort(files.begin(), files.end());
  std::vector<Instrument> catalogue;
  catalogue.reserve(files.size());
  for (const fs::path& file : files) catalogue.push_back(load_instrument(file.string()));
  return catalogue;
}

std::vector<Instrument> load_catalogue() { return load_catalogue((fs::path(data_folder()) / "instruments").string()); }

const Instrument& find_instrument(const std::vector<Instrument>& catalogue, const std::string& name) {
  for (const Instrument& instrument : catalogue)
    if (instrument.name == name) return instrument;
  std::string known;
  for (const Instrument& instrument : catalogue) known += "\n  " + instrument.name;
  throw LoadError(fmt::format("there is no instrument \"{}\"; expected one of:{}", name, known));
}

std::string instrument_file(const std::string& name_or_file, const std::string& folder) {
  const fs::path known = fs::path(data_folder()) / "instruments" / (name_or_file + ".json");
  if (is_file(known)) return known.string();
  for (const fs::path& file : {fs::path(folder) / name_or_file, fs::path(name_or_file)}) {
    if (!is_there(file) || (is_file(file) && !name_or_file.ends_with(".json"))) continue;
    require_file(file.string(), "an instrument's file, or a name of `ostium instruments`");
    return file.string();
  }
  if (name_or_file.ends_with(".json")) {
    throw LoadError(
        fmt::format("there is no instrument file \"{}\"{}; expected a file there, or a name of `ostium instruments`",
                    name_or_file, folder.empty() ? "" : " in " + folder + " nor from here"));
  }
  find_instrument(load_catalogue(), name_or_file);  // throws, listing the catalogue, if there is none
  return known.string();
}

}  // namespace ostium::data
