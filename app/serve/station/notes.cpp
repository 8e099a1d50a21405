#include "app/serve/station/notes.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;

std::string file_in(const std::string& folder) { return (std::filesystem::path(folder) / "notes.json").string(); }

bool is_note(const Json& one) {
  const auto is = [&](const char* key, bool (Json::*right)() const noexcept) {
    return one.contains(key) && (one[key].*right)();
  };
  return one.is_object() && is("recording", &Json::is_string) && is("second", &Json::is_number) &&
         is("note", &Json::is_string);
}

}  // namespace

std::vector<Note> read_notes(const std::string& folder) {
  const std::string file = file_in(folder);
  std::vector<Note> out;
  if (!data::is_there(file)) return out;
  const Json all = Json::parse(data::read_file(file, "what a trainer noted, or no file"), nullptr, false);
  if (!all.is_array() || !std::ranges::all_of(all, is_note))
    throw data::LoadError(file + ": is no list of notes; expected what `ostium` wrote, or no file");
  for (const Json& one : all)
    out.push_back({one["recording"].get<std::string>(), one["second"].get<double>(), one["note"].get<std::string>()});
  return out;
}

void write_notes(const std::string& folder, const std::vector<Note>& notes) {
  Json all = Json::array();
  for (const Note& note : notes)
    all.push_back({{"recording", note.recording}, {"second", note.second}, {"note", note.text}});
  std::error_code none;
  if (all.empty())
    std::filesystem::remove(file_in(folder), none);  // of a run that was here before
  else
    data::write_file(file_in(folder), all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace ostium::app
