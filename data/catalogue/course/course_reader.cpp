#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "data/catalogue/case/case.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/course/course.h"
#include "data/catalogue/course/course_keys.h"
#include "data/catalogue/script/script_condition_reader.h"
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

/// Index of the script's step with this label.
int step_at(const Script& script, const JsonObject& object) {
  std::string known;
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    const std::string& label = script.steps[i].label;
    if (label == object.text("label")) return static_cast<int>(i);
    if (!label.empty()) known += (known.empty() ? "" : ", ") + label;
  }
  object["label"].refuse("a label of the lesson's script: " + known);
}

Instruction read_instruction(const JsonValue& value, const Script& script, bool first) {
  Instruction out;
  out.line = value.line;
  if (value.type == JsonValue::Type::text && !value.text.empty()) {
    out.text = value.text;
    return out;
  }
  if (value.type != JsonValue::Type::object) value.refuse("a text, or an object with text and until, event or label");
  const JsonObject object(value, course_keys::instruction);
  out.text = object.text("text");
  out.until = read_conditions(object, "until", script, {});
  out.meanwhile = read_conditions(object, "while", script, {});
  if (!out.meanwhile.empty() && out.until.empty()) object["while"].refuse("until beside it");
  if (object.has("event")) out.event = object.text("event");
  if (object.has("label")) out.expert_step = step_at(script, object);
  if (out.expert_step >= 0 && !out.ticks()) out.until = script.steps[static_cast<std::size_t>(out.expert_step)].until;
  if (!out.ticks())
    value.fail(value.path() + (out.expert_step < 0
                                   ? " says nothing that ticks it; expected until, event or label"
                                   : ".label is of a step without until; expected until or event, too"));
  out.in_turn = object.has("in_turn") && object.boolean("in_turn");
  if (out.in_turn && first) object["in_turn"].refuse("false: it is the first that ticks itself");
  return out;
}

std::vector<Instruction> read_instructions(const JsonObject& object, const Script& script) {
  std::vector<Instruction> out;
  if (object.list("instructions").empty()) object.refuse("instructions");
  bool first = true;
  for (const JsonValue& one : object.list("instructions")) {
    out.push_back(read_instruction(one, script, first));
    first &= !out.back().ticks();
  }
  return out;
}

/// What lessons name, each file read once: a course of thousands names the same few again and again.
struct Named {
  std::map<std::string, std::optional<vascular::Access>> access_of_case;  ///< none: any
  std::map<std::string, Script> scripts;
};

/// The one of this name, found now if it is the first time.
template <class T, class Find>
const T& found_once(std::map<std::string, T>& known, const std::string& name, const Find& find) {
  const auto at = known.find(name);
  return at != known.end() ? at->second : known.emplace(name, find(name)).first->second;
}

std::optional<vascular::Access> access_of(const std::string& case_name) {
  const Case of_lesson = find_case(case_name);
  return of_lesson.imported ? std::nullopt : std::optional(of_lesson.anatomy.access);
}

Lesson read_lesson(const JsonValue& value, Named& named) {
  const JsonObject object(value, course_keys::lesson);
  Lesson lesson;
  lesson.name = object.text("name");
  if (!is_name(lesson.name)) object.refuse("name");
  lesson.title = object.text("title"), lesson.goal = object.text("goal");
  lesson.case_name = from_course(object, "case"), lesson.script = from_course(object, "script");
  lesson.scoring = from_course(object, "scoring");
  std::optional<vascular::Access> access;
  const Script* expert = nullptr;
  require(object, "case", [&](const std::string& name) { access = found_once(named.access_of_case, name, access_of); });
  require(object, "script", [&](const std::string& name) {
    expert = &found_once(named.scripts, name, find_script);
    require_access(*expert, access, lesson.case_name);
  });
  lesson.instructions = read_instructions(object, *expert);
  if (object.has("person")) lesson.person = static_cast<std::uint64_t>(object.whole("person"));
  if (object.has("begin")) lesson.begin = course_keys::beginnings[object.choice("begin", course_keys::beginnings)];
  if (object.has("set")) lesson.set = texts(object, "set");
  if (!object.list("must_hold").empty()) lesson.must_hold = texts(object, "must_hold");
  for (std::size_t i = 0; i < lesson.must_hold.size(); ++i)
    if (std::find(lesson.must_hold.begin(), lesson.must_hold.begin() + i, lesson.must_hold[i]) !=
        lesson.must_hold.begin() + i)
      object.list("must_hold")[i].refuse("each id once");
  lesson.line = object["must_hold"].line;
  if (object.has("limit_min")) lesson.limit_s = 60 * object.number("limit_min");
  lesson.exam = object.has("exam") && object.boolean("exam");
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
  course.in_order = !(object.has("any_order") && object.boolean("any_order"));
  if (object.list("lessons").empty()) object.refuse("lessons");
  Named named;
  std::set<std::string> names;
  for (const JsonValue& one : object.list("lessons")) {
    course.lessons.push_back(read_lesson(one, named));
    if (!names.insert(course.lessons.back().name).second) one.refuse("a lesson with a name of its own");
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
