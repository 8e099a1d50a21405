#include "app/commands/learn/progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/serve/sitting.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace fs = std::filesystem;
using Json = Progress::Json;

namespace {

bool is_attempt(const Json& one) {
  const auto is = [&](const char* key, bool (Json::*right)() const noexcept) {
    return !one.contains(key) || (one[key].*right)();
  };
  const auto counts = [&](const char* key) {
    return !one.contains(key) || (one[key].is_number_unsigned() && one[key].get<std::uint64_t>() < 1'000'000);
  };
  const auto texts = [&](const char* key) {
    return !one.contains(key) ||
           (one[key].is_array() && std::ranges::all_of(one[key], [](const Json& text) { return text.is_string(); }));
  };
  return one.is_object() && one.contains("done") && one["done"].is_boolean() && counts("attempt") &&
         is("open", &Json::is_boolean) && is("ended", &Json::is_boolean) && is("seconds", &Json::is_number) &&
         counts("hints_asked") && texts("missed") && texts("set");
}

}  // namespace

Progress::Progress(const std::string& folder) : file_((fs::path(folder) / "progress.json").string()) {
  if (!data::is_there(file_)) return;
  all_ = Json::parse(data::read_file(file_, "what `ostium learn` wrote, or no file"), nullptr, false);
  if (!all_.is_object() || !std::ranges::all_of(all_, [](const Json& attempts) {
        return attempts.is_array() && std::ranges::all_of(attempts, is_attempt);
      }))
    throw data::LoadError(file_ + ": is no list of attempts; expected what `ostium learn` wrote, or no file");
}

std::size_t Progress::next(const std::string& lesson) const {
  const Json& all = attempts(lesson);
  if (const std::size_t last = all.empty() ? 0 : all.back().value("attempt", std::size_t{0});
      last > 0 && !all.back().value("ended", false) && !data::is_there(folder_of(lesson, last)))
    return last;  // nothing came of it
  std::size_t number = all.size() + 1;
  while (data::is_there(folder_of(lesson, number))) ++number;
  return number;
}

fs::path Progress::folder_of(const std::string& lesson, std::size_t number) const {
  return fs::path(file_).parent_path() / fmt::format("{}-{}", lesson, number);
}

const Json& Progress::attempts(const std::string& lesson) const {
  static const Json none = Json::array();
  return all_.contains(lesson) ? all_[lesson] : none;
}

bool Progress::done(const std::string& lesson) const {
  return std::ranges::any_of(attempts(lesson), [](const Json& one) { return one["done"].get<bool>(); });
}

bool Progress::is_open(const std::string& lesson) const {
  const Json& all = attempts(lesson);
  return !all.empty() && all.back().value("open", false);
}

std::optional<Progress::Unfinished> Progress::unfinished(const std::string& lesson) const {
  const Json& all = attempts(lesson);
  if (all.empty() || all.back()["done"].get<bool>()) return {};
  const std::size_t number = all.back().value("attempt", std::size_t{0});
  const auto from = where_it_stopped(folder_of(lesson, number).string());
  if (!from) return {};
  return Unfinished{number, *from, all.back().value("set", std::vector<std::string>{})};
}

Json& Progress::attempt(const std::string& lesson, std::size_t number) {
  Json& all = all_[lesson];
  if (all.is_null()) all = Json::array();
  if (all.empty() || all.back().value("attempt", Json()) != Json(number))
    all.push_back({{"attempt", number}, {"done", false}});
  return all.back();
}

void Progress::write() const { data::write_file(file_, all_.dump(2) + "\n"); }

void Progress::begin(const std::string& lesson, std::size_t number, const std::vector<std::string>& set) {
  Json& one = attempt(lesson, number);
  one["open"] = true;
  if (!set.empty()) one["set"] = set;
  write();
}

void Progress::leave(const std::string& lesson, std::size_t number) {
  attempt(lesson, number)["open"] = false;
  write();
}

void Progress::note(const std::string& lesson, std::size_t number, const Verdict& verdict) {
  Json& one = attempt(lesson, number);
  one["done"] = one["done"].get<bool>() || verdict.done;
  one["ended"] = true;
  one["seconds"] = verdict.seconds, one["hints_asked"] = verdict.hints, one["missed"] = verdict.missed;
  write();
}

}  // namespace ostium::app
