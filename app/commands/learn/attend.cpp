#include "app/commands/learn/attend.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "app/command_line/filled_folder.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

data::ScoreList list_of(const data::Course& course, const data::Lesson& lesson) {
  try {
    return data::find_score_list(lesson.scoring);
  } catch (const data::LoadError& error) {
    throw data::LoadError(
        fmt::format("{}:{}: scoring of lesson {}: {}", course.file, lesson.line, lesson.name, error.what()));
  }
}

/// The items that must hold, by their place in the list.
std::vector<std::size_t> must_hold(const data::Course& course, const data::Lesson& lesson,
                                   const data::ScoreList& list) {
  std::vector<std::size_t> out;
  for (const std::string& id : lesson.must_hold) {
    const auto at =
        std::find_if(list.items.begin(), list.items.end(), [&](const data::ScoreItem& item) { return item.id == id; });
    std::string known;
    for (const data::ScoreItem& item : list.items) known += (known.empty() ? "" : ", ") + item.id;
    if (at == list.items.end())
      throw data::LoadError(fmt::format("{}:{}: must_hold of lesson {} names item \"{}\"; expected ids of {}: {}",
                                        course.file, lesson.line, lesson.name, id, lesson.scoring, known));
    if (!at->check)
      throw data::LoadError(
          fmt::format("{}:{}: must_hold of lesson {} names item \"{}\" of {}, which only a person can "
                      "judge; expected items with a check",
                      course.file, lesson.line, lesson.name, id, lesson.scoring));
    out.push_back(static_cast<std::size_t>(at - list.items.begin()));
  }
  return out;
}

void require_events(const data::Course& course, const data::Lesson& lesson) {
  for (const data::Instruction& one : lesson.instructions)
    if (!one.event.empty() && !event_called(one.event))
      throw data::LoadError(
          fmt::format("{}:{}: an instruction of lesson {} waits for the event \"{}\"; expected a name "
                      "of data/assessment/events.def, as tool_in, nitrate, cine_on, stent_deployed",
                      course.file, one.line, lesson.name, one.event));
}

void list_lessons(const data::Course& course, const Progress& progress) {
  fmt::print("{}: {}\n{}\n", course.name, course.title, course.note);
  for (const data::Lesson& lesson : course.lessons) {
    const std::size_t attempts = progress.attempts(lesson.name).size();
    fmt::print("  {} {:<22} {}, {} attempt{}\n", progress.done(lesson.name) ? "x" : " ", lesson.name, lesson.title,
               attempts, attempts == 1 ? "" : "s");
  }
}

/// Place of a lesson in the course; of the first that has not been done, or the last.
std::size_t place_of(const data::Course& course, const Progress& progress, const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < course.lessons.size(); ++i) {
    const data::Lesson& lesson = course.lessons[i];
    if (name.empty() ? !progress.done(lesson.name) : lesson.name == name) return i;
    known += "\n  " + lesson.name;
  }
  if (name.empty()) return course.lessons.size() - 1;
  throw data::LoadError(fmt::format("{} has no lesson \"{}\"; expected one of:{}", course.name, name, known));
}

}  // namespace

void declare_attendance(Options& options, const std::string& lesson, Attendance& a) {
  options.add(lesson, a.lesson, "Opens at once, locked or not; by name").type("NAME");
  options.add("--out", a.folder, "Where attempts and progress.json stay").type("DIR").show_default();
  options.add("--port", a.port, "Of the page; 0: any that is free").range(0, 65535).show_default();
  options.flag("--show", a.show, "The expert does it (the next one), and you watch: no attempt, and nothing is kept");
  options.flag("--list", a.list, "What there is, and what has been done");
  options.exclude("--list", {lesson.c_str(), "--show", "--port"});
}

int attend_course(const data::Course& course, const Attendance& a, const Schooling::ForPerson& for_person) {
  std::vector<CheckedLesson> lessons;
  std::map<std::string, data::ScoreList> lists;  // each read once
  for (const data::Lesson& lesson : course.lessons) {
    if (!lists.contains(lesson.scoring)) lists[lesson.scoring] = list_of(course, lesson);
    data::ScoreList list = lists[lesson.scoring];
    std::vector<std::size_t> needed = must_hold(course, lesson, list);
    require_events(course, lesson);
    lessons.push_back({std::move(list), std::move(needed)});
  }
  const std::string folder = (fs::path(a.folder) / course.name).string();
  if (a.list) {
    list_lessons(course, Progress(folder));
    return 0;
  }
  place_of(course, Progress(folder), a.lesson);  // what is refused leaves no folder
  const FilledFolder filled(folder);
  Progress progress(folder);
  const bool opens = a.show || !a.lesson.empty();
  Ask first;
  if (opens)
    first = {Ask::Kind::lesson, place_of(course, progress, a.lesson), a.show ? Ask::How::shown : Ask::How::go_on};
  else
    for (std::size_t i = 0; i < course.lessons.size() && first.kind == Ask::Kind::none; ++i)
      if (progress.is_open(course.lessons[i].name)) first = {Ask::Kind::lesson, i, Ask::How::go_on};
  return Schooling(course, lessons, progress, for_person).attend(static_cast<std::uint16_t>(a.port), first, opens);
}

}  // namespace ostium::app
