#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/filled_folder.h"
#include "app/commands/serve/serve.h"
#include "data/catalogue/course/course.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::string course = "first-steps", lesson;  ///< lesson empty: the first that has not been done
  std::string folder = "ostium-learn";
  int port = 0;
  bool list = false, show = false;
};

void declare(Options& options, Arguments& a) {
  options.add("course", a.course, "One of data/courses, or a file").type("NAME|FILE.json").show_default();
  options.add("--lesson", a.lesson, "By name; without it the first that has not been done").type("NAME");
  options.add("--out", a.folder, "Where attempts and progress.json stay").type("DIR").show_default();
  options.add("--port", a.port, "Of the page; 0: any that is free").range(0, 65535).show_default();
  options.flag("--show", a.show, "The expert does the lesson, and you watch: no attempt, and nothing is kept");
  options.flag("--list", a.list, "What lessons there are, and what has been done");
  options.exclude("--list", {"--lesson", "--show", "--port"});
}

/// Attempts, by lesson: {"feed-and-turn": [{"attempt": 1, "done": false}, ...]}.
class Progress {
 public:
  explicit Progress(const std::string& folder) : file_((fs::path(folder) / "progress.json").string()) {
    if (!data::is_there(file_)) return;
    all_ = Json::parse(data::read_file(file_, "what `ostium learn` wrote, or no file"), nullptr, false);
    const bool right =
        all_.is_object() && std::all_of(all_.begin(), all_.end(), [](const Json& attempts) {
          return attempts.is_array() && std::all_of(attempts.begin(), attempts.end(), [](const Json& one) {
                   return one.is_object() && one.contains("done") && one["done"].is_boolean();
                 });
        });
    if (!right)
      throw data::LoadError(file_ + ": is no list of attempts; expected what `ostium learn` wrote, or no file");
  }
  /// Number of the next attempt, from 1: also after one that was cut off before it could be noted.
  std::size_t next(const std::string& lesson) const {
    std::size_t number = attempts(lesson) + 1;
    while (data::is_there(folder_of(lesson, number))) ++number;
    return number;
  }
  fs::path folder_of(const std::string& lesson, std::size_t number) const {
    return fs::path(file_).parent_path() / fmt::format("{}-{}", lesson, number);
  }
  std::size_t attempts(const std::string& lesson) const { return all_.contains(lesson) ? all_[lesson].size() : 0; }
  bool done(const std::string& lesson) const {
    return all_.contains(lesson) && std::any_of(all_[lesson].begin(), all_[lesson].end(),
                                                [](const Json& one) { return one["done"].get<bool>(); });
  }
  /// What an attempt has come to so far; one that has been done stays so, whatever a later branch of it does.
  void note(const std::string& lesson, std::size_t number, bool done, const Served& served) {
    Json& all = all_[lesson];
    if (all.empty() || all.back().value("attempt", Json()) != Json(number))
      all.push_back({{"attempt", number}, {"done", false}});
    Json& attempt = all.back();
    attempt["done"] = attempt["done"].get<bool>() || done;
    attempt["seconds"] = served.report.simulated_s;
    data::write_file(file_, all_.dump(2) + "\n");
  }

 private:
  std::string file_;
  Json all_ = Json::object();
};

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

const data::Lesson& chosen(const data::Course& course, const Progress& progress, const std::string& name) {
  std::string known;
  for (const data::Lesson& lesson : course.lessons) {
    if (name.empty() ? !progress.done(lesson.name) : lesson.name == name) return lesson;
    known += "\n  " + lesson.name;
  }
  if (name.empty()) return course.lessons.back();
  throw data::LoadError(fmt::format("{} has no lesson \"{}\"; expected one of:{}", course.name, name, known));
}

void list_lessons(const data::Course& course, const Progress& progress) {
  fmt::print("{}: {}\n{}\n", course.name, course.title, course.note);
  for (const data::Lesson& lesson : course.lessons)
    fmt::print("  {} {:<22} {}, {} attempt{}\n", progress.done(lesson.name) ? "x" : " ", lesson.name, lesson.title,
               progress.attempts(lesson.name), progress.attempts(lesson.name) == 1 ? "" : "s");
}

/// Whether everything that must hold did.
bool is_done(const std::vector<std::size_t>& needed, const Served& served) {
  return !served.scores.empty() &&
         std::ranges::all_of(needed, [&](std::size_t item) { return served.scores[item].holds == data::Ticked::yes; });
}

/// What was expected and what happened.
void tell(const data::ScoreList& list, const std::vector<std::size_t>& needed, const Served& served) {
  if (served.scores.empty()) {
    fmt::print("The lesson was left before its end.\n");
    return;
  }
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const data::Score& score = served.scores[i];
    const bool holds = score.holds == data::Ticked::yes;
    const bool must = std::find(needed.begin(), needed.end(), i) != needed.end();
    const bool step = list.items[i].kind == data::ScoreKind::step;
    fmt::print("  {:<14} {}{}{}\n",
               score.holds == data::Ticked::not_seen ? "cannot tell"
               : step                                ? holds ? "done" : "not done"
               : holds                               ? "did not happen"
                                                     : "happened",
               list.items[i].what, score.value.empty() ? "" : ": " + score.value, must ? " (needed to go on)" : "");
  }
}

ServeArguments serving_of(const data::Lesson& lesson, int port) {
  ServeArguments serving;
  serving.session.vessel = lesson.case_name, serving.session.script = lesson.script;
  if (lesson.person) serving.session.set.push_back(fmt::format("person={}", *lesson.person));
  if (!lesson.begin.empty()) serving.session.set.push_back("begin=" + lesson.begin);
  serving.port = port, serving.hands = "browser", serving.scoring = lesson.scoring, serving.report = false;
  serving.lesson = {lesson.title, lesson.goal, lesson.instructions, {}, ""};
  return serving;
}

int run(const Arguments& a) {
  const data::Course course = data::find_course(a.course);
  std::vector<std::vector<std::size_t>> needed;
  for (const data::Lesson& lesson : course.lessons)
    needed.push_back(must_hold(course, lesson, list_of(course, lesson)));
  const std::string folder = (fs::path(a.folder) / course.name).string();
  Progress progress(folder);
  if (a.list) {
    list_lessons(course, progress);
    return 0;
  }
  const data::Lesson& lesson = chosen(course, progress, a.lesson);
  const auto place = static_cast<std::size_t>(&lesson - course.lessons.data());
  ServeArguments serving = serving_of(lesson, a.port);
  serving.lesson.title = fmt::format("{} of {}: {}", place + 1, course.lessons.size(), lesson.title);
  if (a.show) {
    serving.hands = "script";
    serving.lesson.title += " (shown by the expert)";
    fmt::print("{}\nOpen the first of these links in a browser, and press Go on.\n", serving.lesson.title);
    tell(data::find_score_list(lesson.scoring), needed[place], serve(serving));
    return 0;
  }
  const FilledFolder filled(folder);
  progress = Progress(folder);  // as another left it before it was ours
  const std::size_t attempt = progress.next(lesson.name);
  serving.folder = progress.folder_of(lesson.name, attempt).string();
  serving.lesson.needed = needed[place];
  const bool last = place + 1 == course.lessons.size();
  if (!last) serving.lesson.next = course.lessons[place + 1].title;
  bool done = false;
  serving.ended = [&](const Served& served) {
    done |= is_done(needed[place], served);
    progress.note(lesson.name, attempt, done, served);
  };
  fmt::print("{}\nGoal: {}\nOpen the first of these links in a browser.\n", serving.lesson.title, lesson.goal);
  const Served served = serve(serving);
  tell(data::find_score_list(lesson.scoring), needed[place], served);
  progress.note(lesson.name, attempt, done, served);
  if (done)
    fmt::print("Done.{}\n", last ? "" : " Next: " + serving.lesson.next + " (the same command)");
  else
    fmt::print("Not yet: once more, with the same command.\n");
  return done ? 0 : 1;
}

}  // namespace

Command learn_command() {
  return make_command("learn", "Lessons in the browser, one after another",
                      {"ostium learn", "ostium learn --show", "ostium learn --list",
                       "ostium learn my-course.json --lesson over-the-arch"},
                      declare, run);
}

}  // namespace ostium::app
