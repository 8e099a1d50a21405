#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "data/catalogue/case/case.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/course/course.h"
#include "data/catalogue/course/course_keys.h"
#include "data/catalogue/script/script.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> texts(const JsonObject& object, const char* key) {
  std::vector<std::string> out;
  if (object.list(key).empty()) object.refuse(key);
  for (const JsonValue& one : object.list(key)) {
    if (one.type != JsonValue::Type::text || one.text.empty()) one.refuse("a text");
    out.push_back(one.text);
  }
  return out;
}

bool is_name(const std::string& text) {
  constexpr std::size_t longest = 60;  // a folder is called so
  return text.size() <= longest && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
         });
}

/// What a course names is looked for where the course is, then as everything is; so a folder can be handed on.
std::string from_course(const JsonObject& object, const char* key) {
  const fs::path beside = fs::path(*object[key].file).parent_path() / object.text(key);
  return is_there(beside) ? beside.string() : object.text(key);
}

/// Says where in the course it was asked for.
template <class Find>
void require(const JsonObject& object, const char* key, const Find& find) {
  try {
    find(from_course(object, key));
  } catch (const LoadError& error) {
    object[key].fail(fmt::format("{} is \"{}\": {}", object[key].path(), object.text(key), error.what()));
  }
}

Lesson read_lesson(const JsonValue& value) {
  const JsonObject object(value, course_keys::lesson);
  Lesson lesson;
  lesson.name = object.text("name");
  if (!is_name(lesson.name)) object.refuse("name");
  lesson.title = object.text("title"), lesson.goal = object.text("goal");
  lesson.instructions = texts(object, "instructions");
  lesson.case_name = from_course(object, "case"), lesson.script = from_course(object, "script");
  lesson.scoring = from_course(object, "scoring");
  std::optional<vascular::Access> access;
  require(object, "case", [&](const std::string& name) {
    const Case of_lesson = find_case(name);
    if (!of_lesson.imported) access = of_lesson.anatomy.access;
  });
  require(object, "script",
          [&](const std::string& name) { require_access(find_script(name), access, lesson.case_name); });
  if (object.has("person")) lesson.person = static_cast<std::uint64_t>(object.whole("person"));
  if (object.has("begin")) lesson.begin = course_keys::beginnings[object.choice("begin", course_keys::beginnings)];
  lesson.must_hold = texts(object, "must_hold");
  for (std::size_t i = 0; i < lesson.must_hold.size(); ++i)
    if (std::find(lesson.must_hold.begin(), lesson.must_hold.begin() + i, lesson.must_hold[i]) !=
        lesson.must_hold.begin() + i)
      object.list("must_hold")[i].refuse("each id once");
  lesson.line = object["must_hold"].line;
  return lesson;
}

}  // namespace

Course read_course(const std::string& file, const std::string& text) {
  const JsonValue value = parse_json(file, text);
  const JsonObject object(value, course_keys::root);
  if (object.text("schema") != "ostium-course/1") object.refuse("schema");
  Course course;
  course.file = file;
  course.name = object.text("name"), course.title = object.text("title"), course.note = object.text("note");
  if (course.name != fs::path(file).stem().string()) object.refuse("name");
  if (object.list("lessons").empty()) object.refuse("lessons");
  for (const JsonValue& one : object.list("lessons")) {
    course.lessons.push_back(read_lesson(one));
    for (std::size_t i = 0; i + 1 < course.lessons.size(); ++i)
      if (course.lessons[i].name == course.lessons.back().name) one.refuse("a lesson with a name of its own");
  }
  return course;
}

std::vector<std::string> course_names() {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(data_folder()) / "courses", none))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Course find_course(const std::string& name_or_file) {
  const fs::path known = fs::path(data_folder()) / "courses" / (name_or_file + ".json");
  const std::string file = is_file(known) ? known.string() : name_or_file;
  if (!is_there(file)) {
    std::string names;
    for (const std::string& name : course_names()) names += "\n  " + name;
    throw LoadError(
        fmt::format("there is no course \"{}\"; expected a file NAME.json or one of:{}", name_or_file, names));
  }
  return read_course(file, read_file(file, "a course", json_limits::bytes));
}

}  // namespace ostium::data
