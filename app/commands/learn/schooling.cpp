#include "app/commands/learn/schooling.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/command_line/interrupt.h"
#include "app/command_line/links.h"
#include "app/serve/messages/hints.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

/// What the page says of the instructions: each with the expert's steps up to those of the next.
std::vector<LessonWords::Instruction> words_of(const data::Lesson& lesson) {
  const data::Script script = data::find_script(lesson.script);
  std::vector<LessonWords::Instruction> out;
  for (std::size_t i = 0; i < lesson.instructions.size(); ++i) {
    const data::Instruction& one = lesson.instructions[i];
    int end = -1;
    for (std::size_t k = i + 1; k < lesson.instructions.size() && end < 0; ++k)
      if (lesson.instructions[k].expert_step > one.expert_step) end = lesson.instructions[k].expert_step;
    std::vector<std::string> hints;
    if (one.expert_step >= 0 && !lesson.exam) hints = hints_of(script, one.expert_step, end);
    out.push_back({one.text, one.ticks(), std::move(hints)});
  }
  return out;
}

/// An item of the list that must hold, as a condition.
std::string needed_words(const data::ScoreItem& item) {
  return (item.kind == data::ScoreKind::step ? "" : "Must not happen: ") + item.what;
}

/// "tool=instrument" in place of what was set for that tool.
void replace_tools(const std::vector<std::string>& chosen, std::vector<std::string>& set) {
  for (const std::string& one : chosen) {
    const std::string tool = one.substr(0, one.find('=') + 1);
    std::erase_if(set, [&](const std::string& other) { return other.starts_with(tool); });
    set.push_back(one);
  }
}

/// What was expected and what happened.
void tell(const CheckedLesson& lesson, const Served& served) {
  for (std::size_t i = 0; i < lesson.list.items.size(); ++i) {
    const data::Score& score = served.scores[i];
    const bool holds = score.holds == data::Ticked::yes;
    const bool must = std::ranges::find(lesson.needed, i) != lesson.needed.end();
    const bool step = lesson.list.items[i].kind == data::ScoreKind::step;
    fmt::print("  {:<14} {}{}{}\n",
               score.holds == data::Ticked::not_seen ? "cannot tell"
               : step                                ? holds ? "done" : "not done"
               : holds                               ? "did not happen"
                                                     : "happened",
               lesson.list.items[i].what, score.value.empty() ? "" : ": " + score.value,
               must ? " (needed to go on)" : "");
  }
  std::fflush(stdout);
}

}  // namespace

/// Of each lesson's tools: what else of its kind there is.
void Schooling::find_tools() {
  person_ = course_.lessons.front().person;
  std::map<data::InstrumentKind, std::vector<std::string>> shelf;
  std::map<std::string, data::InstrumentKind> kinds;
  for (const data::Instrument& one : data::load_catalogue())
    shelf[one.kind].push_back(one.name), kinds[one.name] = one.kind;
  for (const data::Lesson& lesson : course_.lessons) {
    std::vector<CourseBoard::Lesson::Tool>& own = tools_.emplace_back();
    for (const data::ScriptTool& tool : data::find_script(lesson.script).tools)
      if (const auto kind = kinds.find(tool.instrument); kind != kinds.end())
        own.push_back({tool.name, tool.sizes.empty() ? tool.instrument : "by size", shelf[kind->second]});
  }
}

void Schooling::choose(std::optional<std::uint64_t> person) {
  course_ = for_person_(person);
  person_ = person;
}

ServeArguments Schooling::serving_of(std::size_t place) const {
  const data::Lesson& lesson = course_.lessons[place];
  ServeArguments serving;
  serving.session.vessel = lesson.case_name, serving.session.script = lesson.script;
  if (lesson.person) serving.session.set.push_back(fmt::format("person={}", *lesson.person));
  serving.session.set.insert(serving.session.set.end(), lesson.set.begin(), lesson.set.end());
  if (!lesson.begin.empty()) serving.session.set.push_back("begin=" + lesson.begin);
  serving.hands = "browser", serving.scoring = lesson.scoring, serving.report = false;
  serving.lesson = {fmt::format("{} of {}: {}", place + 1, course_.lessons.size(), lesson.title),
                    lesson.goal,
                    words_of(lesson),
                    {},
                    ""};
  serving.instructions = lesson.instructions;
  serving.lesson.exam = lesson.exam, serving.session.seconds = lesson.limit_s;
  return serving;
}

Progress::Verdict Schooling::verdict(std::size_t place, const Served& served) const {
  const CheckedLesson& lesson = lessons_[place];
  Progress::Verdict out;
  for (const std::size_t item : lesson.needed)
    if (served.scores[item].holds != data::Ticked::yes) out.missed.push_back(needed_words(lesson.list.items[item]));
  out.done = out.missed.empty(), out.seconds = served.report.simulated_s;
  for (const data::Metric& metric : served.report.metrics)
    if (metric.name == "hints_asked" && metric.value > 0) out.hints = static_cast<int>(metric.value);
  return out;
}

CourseBoard Schooling::board(std::optional<std::size_t> at) const {
  CourseBoard board;
  board.chooses_person = for_person_ != nullptr, board.person = person_;
  board.title = course_.title, board.note = course_.note, board.problem = problem_, board.at = at;
  bool before = true;
  board.next = course_.lessons.size();
  for (std::size_t i = 0; i < course_.lessons.size(); ++i) {
    const data::Lesson& lesson = course_.lessons[i];
    CourseBoard::Lesson own;
    own.title = lesson.title, own.goal = lesson.goal, own.exam = lesson.exam;
    if (for_person_) own.tools = tools_[i];
    for (const std::size_t item : lessons_[i].needed)
      own.must_hold.push_back(needed_words(lessons_[i].list.items[item]));
    for (const auto& one : progress_.attempts(lesson.name))
      if (one.value("ended", false) ||
          data::is_there(progress_.folder_of(lesson.name, one.value("attempt", std::size_t{0}))))
        own.attempts.push_back({one.value("attempt", std::size_t{0}), one["done"].get<bool>(),
                                one.value("ended", false), one.value("seconds", 0.0), one.value("hints_asked", 0),
                                one.value("missed", std::vector<std::string>{})});
    own.done = progress_.done(lesson.name);
    own.locked = course_.in_order && !before && progress_.attempts(lesson.name).empty();
    own.goes_on = progress_.unfinished(lesson.name).has_value();
    before = own.done;
    if (!own.done) board.next = std::min(board.next, i);
    board.lessons.push_back(std::move(own));
  }
  return board;
}

void Schooling::tell_problem(const std::string& what) {
  problem_ = what;
  fmt::print(stderr, "ostium: {}\n", what);
}

/// Of the progress. What cannot be written is written with the next change.
void Schooling::kept(const std::function<void()>& change) {
  try {
    change();
    problem_.clear();
  } catch (const data::WriteError& error) {
    tell_problem(std::string("what was done is not kept: ") + error.what());
  }
}

/// An attempt that was left or cut off goes on, unless a new one is asked for, or it cannot.
void Schooling::attempt(ServeArguments& serving, std::size_t place, const Ask& ask) {
  const data::Lesson& lesson = course_.lessons[place];
  const auto unfinished = ask.how == Ask::How::go_on ? progress_.unfinished(lesson.name) : std::nullopt;
  const std::size_t number = unfinished ? unfinished->number : progress_.next(lesson.name);
  serving.folder = progress_.folder_of(lesson.name, number).string();
  serving.lesson.needed = lessons_[place].needed;
  if (place + 1 < course_.lessons.size()) serving.lesson.next = course_.lessons[place + 1].title;
  if (unfinished) serving.resumes = unfinished->from;
  const std::vector<std::string>& set = unfinished ? unfinished->set : ask.set;
  replace_tools(set, serving.session.set);
  Classroom& room = *serving.classroom;
  serving.ended = [&, place, number](const Served& served) {
    kept([&] { progress_.note(lesson.name, number, verdict(place, served)); });
    room.show(board(place));
    tell(lessons_[place], served);
    if (!problem_.empty()) throw data::WriteError(problem_);
  };
  progress_.begin(lesson.name, number, set);
  try {
    fmt::print("{}, attempt {}{}\n", serving.lesson.title, number, unfinished ? " goes on" : "");
    std::fflush(stdout);
    serve(serving);
  } catch (const data::LoadError& error) {
    kept([&] { progress_.leave(lesson.name, number); });  // or the next start would come back to it
    if (!unfinished) throw;
    fmt::print(stderr, "{}\nostium: attempt {} cannot go on; a new one begins\n", error.what(), number);
    serving.resumes.reset();
    return attempt(serving, place, {Ask::Kind::lesson, place, Ask::How::afresh, unfinished->set});
  } catch (...) {
    kept([&] { progress_.leave(lesson.name, number); });
    throw;
  }
  if (!interrupted) kept([&] { progress_.leave(lesson.name, number); });
}

void Schooling::open(Classroom& room, const Ask& ask) {
  ServeArguments serving = serving_of(ask.lesson);
  serving.classroom = &room;
  if (ask.how != Ask::How::shown) return attempt(serving, ask.lesson, ask);
  replace_tools(ask.set, serving.session.set);
  serving.hands = "script";
  serving.lesson.title += " (shown by the expert)";
  serve(serving);
}

int Schooling::attend(std::uint16_t port, const Ask& first, bool required) {
  Classroom room("127.0.0.1", port);
  room.show(board({}));
  stop_on_signals();
  fmt::print("{}\nOpen the first of these links in a browser; lessons are chosen there.\n", course_.title);
  tell_links("trainer", room.trainer_link(), room.viewer_link(), false);
  Ask ask = first;
  while (!interrupted && ask.kind != Ask::Kind::close) {
    if (ask.kind == Ask::Kind::lesson) {
      CourseBoard opening = board(ask.lesson);
      opening.opening = true;
      room.show(opening);
      problem_.clear();
      try {
        open(room, ask);
      } catch (const std::runtime_error& error) {  // LoadError, WriteError, MeshError
        if (required) throw;
        tell_problem(fmt::format("{}: {}", course_.lessons[ask.lesson].title, error.what()));
      }
      required = false;
      ask = room.take();
    } else {
      if (ask.kind == Ask::Kind::person) choose(ask.person);
      room.show(board({}));
      ask = room.wait(interrupted);
    }
  }
  return 0;
}

}  // namespace ostium::app
