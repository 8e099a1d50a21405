#include "app/commands/workbench/case_folder.h"

#include <fmt/format.h>

#include <Eigen/Core>

#include "app/command_line/path_lock.h"
#include "app/commands/import/imported.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"

namespace ostium::app {

namespace fs = std::filesystem;
using Json = data::CaseDraft::Json;

namespace {

bool ships(const std::string& file) {
  std::error_code none;
  return fs::equivalent(fs::path(file).parent_path(), fs::path(data::data_folder()) / "cases", none);
}

void fill(const data::CaseDraft& draft, const fs::path& folder, const std::string& name) {
  const fs::path from = fs::path(draft.file()).parent_path();
  for (const data::FileText& one : draft.texts(name)) data::write_file((folder / one.path).string(), one.bytes);
  std::vector<std::string> kept = draft.lumen_files();
  if (draft.imported() && data::is_file(from / "import.json")) kept.push_back("import.json");
  for (const std::string& file : kept) {
    std::error_code error;
    fs::copy_file(from / file, folder / file, fs::copy_options::overwrite_existing, error);
    if (error) throw data::write_error((folder / file).string(), error.message());
  }
}

}  // namespace

void save(data::CaseDraft& draft, const std::optional<fs::file_time_type>& read_at) {
  const fs::path file = draft.file();
  if (ships(file.string()))
    throw data::LoadError("this case ships with Ostium and stays as it is; save it under a name");
  if (written_at(file) != read_at)
    throw data::LoadError(file.string() + ": somebody wrote there meanwhile, which is kept; save under another name");
  std::vector<data::FileText> texts = draft.texts(file.stem().string());
  for (data::FileText& one : texts) one.path = (file.parent_path() / one.path).string();
  texts.front().path = file.string();
  data::write_files(texts);
  draft.saved_as(file.string());
}

void save_as(data::CaseDraft& draft, const std::string& name) {
  const fs::path folder = fs::absolute(fs::path(data::imported_folder()) / name);
  std::error_code error;
  if (data::is_there(fs::path(data::data_folder()) / "cases" / (name + ".json")))
    throw data::LoadError(name + ": is a case that ships, and would hide this one; expected another name");
  if (data::is_there(folder))
    throw data::LoadError(folder.string() + ": is there already, and is kept; expected a new name");
  fs::create_directories(folder.parent_path(), error);
  const fs::path unfinished = folder.string() + ".unfinished";
  fs::create_directory(unfinished, error);
  if (error) throw data::write_error(unfinished.string(), error.message());
  const PathLock lock(unfinished.string());
  try {
    fill(draft, unfinished, name);
    fs::rename(unfinished, folder, error);
    if (error) throw data::write_error(folder.string(), error.message());
  } catch (...) {
    fs::remove_all(unfinished, error);
    throw;
  }
  draft.saved_as((folder / (name + ".json")).string());
}

std::string copy_into(const data::CaseDraft& draft, const fs::path& folder) {
  std::error_code error;
  const std::string name = fs::path(draft.file()).stem().string();
  fs::create_directories(folder / name, error);
  if (error) throw data::write_error(folder.string(), error.message());
  fill(draft, folder / name, name);
  return (folder / name / (name + ".json")).string();
}

std::string mends_beside(const std::string& file) try {
  const fs::path report = fs::path(file).parent_path() / "import.json";
  if (!data::is_file(report)) return "";
  const Json import = Json::parse(data::read_file(report.string(), "what an import wrote"));
  const Json &axes = import.at("axes"), &origin = import.at("origin_mm");
  const auto placed = [&](const Json& p) {
    Json out = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
      double sum = -origin.at(i).get<double>();
      for (std::size_t j = 0; j < 3; ++j) sum += axes.at(i).at(j).get<double>() * p.at(j).get<double>();
      out.push_back(sum);
    }
    return out;
  };
  Json out = Json::array();
  for (const Json& mend : import.at("mends")) {
    Json places = Json::array();
    for (const Json& p : mend.at("where_mm")) places.push_back(placed(p));
    out.push_back({{"words", fmt::format("{} x {}", mend.at("count").get<long>(), mend.at("what").get<std::string>())},
                   {"places", places}});
  }
  for (const Json& note : import.at("notes"))
    out.push_back({{"words", note.get<std::string>()}, {"places", Json::array()}});
  return out.dump();
} catch (const std::exception&) {
  return "";  // written by hand, or another version's: nothing else needs it
}

}  // namespace ostium::app
