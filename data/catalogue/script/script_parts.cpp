#include "data/catalogue/script/script_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "data/catalogue/script/script_actions.h"
#include "data/catalogue/script/script_condition_reader.h"
#include "data/catalogue/script/script_keys.h"
#include "data/catalogue/script/script_values.h"

namespace ostium::data {

namespace {

namespace fs = std::filesystem;
constexpr int deepest_script = 8;

/// Far beyond what a procedure needs. Parts of parts multiply, so depth alone would be no limit.
constexpr int most_parts = 1000;
constexpr std::size_t most_steps = 4'000;  // a recording keeps no more names

JsonValue* member(JsonValue& object, const std::string& key) {
  for (auto& [name, value] : object.members)
    if (name == key) return &value;
  return nullptr;
}

bool is_label(const std::string& otherwise) { return otherwise != "fail" && otherwise != "go on"; }

/// Sends a failing step of a part to the label given beside the part: if the step has no `otherwise` of its own, or
/// once its own tries are used up.
void lead_out(const JsonObject& step, JsonValue& one) {
  const JsonValue* action = one.find("do");
  if (!action || !may_fail(action->text)) return;
  if (const JsonValue* own = one.find("otherwise")) {
    if (is_label(own->text) && !one.find("last_resort")) one.members.push_back({"last_resort", step["otherwise"]});
  } else if (!one.find("tries")) {  // `tries` without `otherwise` is left for the reader to refuse
    for (const char* key : {"otherwise", "tries"})
      if (step.has(key)) one.members.push_back({key, step[key]});
  }
}

bool has_tool(const JsonObject& script, const std::string& name) {
  const std::vector<JsonValue>& tools = script.list("tools");
  return std::any_of(tools.begin(), tools.end(),
                     [&](const JsonValue& tool) { return JsonObject(tool, script_keys::tool).text("name") == name; });
}

/// Applies what the calling step says to the part's steps: prefix of the labels, tools, lesion, and where they jump
/// when they fail.
void say_in_steps(const JsonObject& step, JsonValue& part) {
  const JsonValue* with = step.value().find("with");
  const auto rename = [&](JsonValue& tool) {
    if (const JsonValue* own = with ? with->find(tool.text) : nullptr) tool.text = own->text;
  };
  for (JsonValue& tool : member(part, "tools")->items)
    if (JsonValue* name = member(tool, "name")) rename(*name);
  for (JsonValue& one : member(part, "steps")->items) {
    if (JsonValue* tool = member(one, "tool")) {
      rename(*tool);
      for (JsonValue& each : tool->items) rename(each);
    }
    for (const char* key : {"label", "otherwise", "last_resort"}) {
      JsonValue* label = step.has("label") ? member(one, key) : nullptr;
      if (label && is_label(label->text)) label->text = step.text("label") + ": " + label->text;
    }
    if (step.has("otherwise")) lead_out(step, one);
    for (const char* key : {"until", "unless"}) {
      JsonValue* list = member(one, key);
      if (!list) continue;
      for (JsonValue& condition : list->items) {
        if (JsonValue* of = member(condition, "of")) rename(*of);
        if (step.has("lesion") && has_condition_about_a_lesion(condition) && !condition.find("lesion"))
          condition.members.push_back({"lesion", step["lesion"]});
      }
    }
  }
}

void require_few(std::size_t steps, const JsonValue& last) {
  if (steps > most_steps)
    last.fail(
        fmt::format("{}: the script stands for more than {} steps; expected fewer: split it", last.path(), most_steps));
}

/// Substitutes the values of `file`, overridden by those of `given`; then expands its parts. `parts` counts them.
bool write_out(JsonValue& file, const JsonValue* given, int depth, int& parts) {
  bool any = write_out_values(file, given);
  const JsonObject root(file, script_keys::root);
  if (root.text("schema") != "ostium-script/1") root.refuse("schema");
  std::vector<JsonValue> steps;
  for (const JsonValue& value : root.list("steps")) {
    const JsonValue* action = value.find("do");
    if (!action || action->text != stands_for_steps) {
      steps.push_back(value);
      continue;
    }
    const JsonObject step(value, script_keys::step);
    require_keys(step);
    if (depth == deepest_script)
      value.fail(fmt::format("{}: scripts in scripts deeper than {}; expected at most that: is there a ring of them?",
                             value.path(), depth));
    if (++parts > most_parts)
      value.fail(fmt::format("{}: the script stands for more than {} parts; expected fewer: split it", value.path(),
                             most_parts));
    any = true;
    JsonValue part = load_json((fs::path(*file.file).parent_path() / (step.text("script") + ".json")).string());
    write_out(part, step.value().find("values"), depth + 1, parts);
    read_lesion(step);
    if (step.has("with") && step["with"].type != JsonValue::Type::object) step.refuse("with");
    if (step.has("with"))
      for (const auto& [theirs, ours] : step["with"].members)
        if (!has_tool(JsonObject(part, script_keys::root), theirs) || !has_tool(root, ours.text))
          ours.fail(fmt::format("{}: expected a tool of {} and the name of one of this script's", ours.path(),
                                step.text("script")));
    if (step.has("otherwise") && !is_label(step.text("otherwise"))) step.refuse("otherwise");
    if (step.has("tries") && !step.has("otherwise")) step.refuse("tries");
    say_in_steps(step, part);
    for (const JsonValue& tool : JsonObject(part, script_keys::root).list("tools"))
      if (const std::string name = JsonObject(tool, script_keys::tool).text("name"); !has_tool(root, name))
        value.fail(fmt::format("{}: {} moves a tool \"{}\", and this script has none", value.path(),
                               step.text("script"), name));
    for (JsonValue& one : member(part, "steps")->items) steps.push_back(std::move(one));
    require_few(steps.size(), value);
  }
  if (!steps.empty()) require_few(steps.size(), root.list("steps").back());
  if (any) member(file, "steps")->items = std::move(steps);
  return any;
}

}  // namespace

bool write_out_parts(JsonValue& script) {
  int parts = 0;
  return write_out(script, nullptr, 0, parts);
}

}  // namespace ostium::data
