#include "app/serve/classroom/classroom.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/serve/page/page_files.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;

std::string message_of(const CourseBoard& board) {
  Json lessons = Json::array();
  for (const CourseBoard::Lesson& lesson : board.lessons) {
    Json attempts = Json::array();
    for (const CourseBoard::Attempt& one : lesson.attempts)
      attempts.push_back({{"number", one.number},
                          {"done", one.done},
                          {"ended", one.ended},
                          {"seconds", std::round(one.seconds)},
                          {"hints", one.hints},
                          {"missed", one.missed}});
    Json tools = Json::array();
    for (const CourseBoard::Lesson::Tool& tool : lesson.tools)
      tools.push_back({{"name", tool.name}, {"instrument", tool.instrument}, {"others", tool.others}});
    lessons.push_back({{"title", lesson.title},
                       {"goal", lesson.goal},
                       {"must_hold", lesson.must_hold},
                       {"attempts", attempts},
                       {"done", lesson.done},
                       {"locked", lesson.locked},
                       {"goes_on", lesson.goes_on},
                       {"exam", lesson.exam},
                       {"tools", tools}});
  }
  return Json({{"type", "course"},
               {"title", board.title},
               {"note", board.note},
               {"problem", board.problem},
               {"lessons", lessons},
               {"chooses_person", board.chooses_person},
               {"person", board.person ? Json(*board.person) : Json(nullptr)},
               {"next", board.next},
               {"at", board.at ? Json(*board.at) : Json(nullptr)},
               {"opening", board.opening}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);  // a problem names files
}

/// Whether "tool=instrument" is on offer for the lesson.
bool is_offered(const CourseBoard::Lesson& lesson, const std::string& set) {
  return std::ranges::any_of(lesson.tools, [&](const CourseBoard::Lesson::Tool& tool) {
    return std::ranges::any_of(tool.others, [&](const std::string& one) { return set == tool.name + "=" + one; });
  });
}

}  // namespace

Classroom::Classroom(const std::string& address, std::uint16_t port)
    : address_(address), trainer_token_(make_token()), viewer_token_(make_token()) {
  ServerSettings settings;
  settings.address = address, settings.port = port;
  settings.trainer_token = trainer_token_, settings.viewer_token = viewer_token_;
  settings.pages = page_files();
  server_ = std::make_unique<Server>(std::move(settings), *this);
}

void Classroom::show(const CourseBoard& board) {
  const std::lock_guard lock(mutex_);
  board_ = board;
  server_->send(Channel::all, {message_of(board), false});
}

void Classroom::enter(Station& station) {
  {
    const std::lock_guard lock(mutex_);
    station_ = &station;
    board_.opening = false;
    if (ask_.kind != Ask::Kind::none) station.leave();  // asked while it was being opened
  }
  server_->greet_all();
}

void Classroom::leave() {
  const std::lock_guard lock(mutex_);
  station_ = nullptr;
}

Ask Classroom::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ask_, Ask{});
}

Ask Classroom::wait(const std::atomic<bool>& stop) {
  std::unique_lock lock(mutex_);
  while (ask_.kind == Ask::Kind::none && !stop) asked_.wait_for(lock, std::chrono::milliseconds(100));
  return std::exchange(ask_, Ask{});
}

std::vector<std::string> Classroom::greet(Role role) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> out = {
      Json({{"type", "role"}, {"role", role == Role::trainer ? "trainer" : "viewer"}}).dump()};
  if (!board_.lessons.empty()) out.push_back(message_of(board_));
  if (!station_) return out;
  const std::vector<std::string> own = station_->greet(role);
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

void Classroom::lost_trainer() {
  const std::lock_guard lock(mutex_);
  if (station_) station_->lost_trainer();
}

std::string Classroom::open_lesson(const data::JsonValue& message) {
  const data::JsonValue* values = message.find("values");
  const auto whole = [&](std::size_t i, double most) {
    const bool there = values && i < values->items.size() && values->items[i].type == data::JsonValue::Type::number;
    const double value = there ? values->items[i].number : -1;
    return value >= 0 && value <= most && value == std::floor(value) ? static_cast<int>(value) : -1;
  };
  const int lesson = whole(0, static_cast<double>(board_.lessons.size()) - 1), how = whole(1, 2);
  if (lesson < 0 || how < 0 || values->items.size() != 2)
    return refusal("lesson", "expected a lesson of the list, from 0, and 0 (go on), 1 (afresh) or 2 (shown)");
  const auto place = static_cast<std::size_t>(lesson);
  if (board_.lessons[place].locked) return refusal("lesson", "it is locked until the lesson before it is passed");
  if (board_.lessons[place].exam && how == static_cast<int>(Ask::How::shown))
    return refusal("lesson", "it is an exam: the expert does not show it");
  Ask ask{Ask::Kind::lesson, place, static_cast<Ask::How>(how)};
  if (const data::JsonValue* set = message.find("set"))
    for (const data::JsonValue& one : set->items) {
      if (!is_offered(board_.lessons[place], one.text))
        return refusal("lesson", "expected instruments that are on the lesson's list, as \"guide=guide-jr4-6f\"");
      ask.set.push_back(one.text);
    }
  ask_ = std::move(ask);
  return "";
}

std::string Classroom::take_person(const data::JsonValue& message) {
  if (!board_.chooses_person) return refusal("person", "this course says whose arteries they are");
  const data::JsonValue* values = message.find("values");
  Ask ask{.kind = Ask::Kind::person};
  if (values && !values->items.empty()) {
    const data::JsonValue& one = values->items.front();
    if (one.type != data::JsonValue::Type::number || !(one.number >= 0 && one.number <= 1e6) ||
        one.number != std::floor(one.number))
      return refusal("person", "expected a whole number, 0 to 1000000, or none");
    ask.person = static_cast<std::uint64_t>(one.number);
  }
  ask_ = std::move(ask);
  return "";
}

std::string Classroom::obey(const std::string& what, const data::JsonValue& message) {
  if (what == "lesson") {
    if (std::string why = open_lesson(message); !why.empty()) return why;
  } else if (what == "person") {
    if (std::string why = take_person(message); !why.empty()) return why;
  } else {
    ask_ = {.kind = what == "course" ? Ask::Kind::list : Ask::Kind::close};
  }
  if (station_) station_->leave();
  asked_.notify_all();
  return "";
}

std::string Classroom::hear(Role role, const std::string& text) {
  std::string what = "?";
  const std::lock_guard lock(mutex_);
  try {
    const data::JsonValue message = data::parse_json("message", text);
    const data::JsonValue* name = message.find("do");
    if (name) what = name->text.substr(0, 40);
    const bool own = what == "lesson" || what == "person" || what == "course" || what == "close";
    if (own && role == Role::trainer) return obey(what, message);
    if (own) return refusal(what, "viewers look on; the learner's link has the lessons");
    if (station_) return station_->hear(role, text);
    return what == "here" ? "" : refusal(what, "no lesson is open");
  } catch (const data::LoadError& error) {
    return refusal(what, error.what());
  }
}

}  // namespace ostium::app
