#include "data/catalogue/script/script_condition_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "data/catalogue/script/script_keys.h"

namespace ostium::data {

namespace {

JsonType type_of(const ConditionRow& row) {
  switch (row.value) {
    case ConditionValue::number:
      return json_type::number(row.range);
    case ConditionValue::only_true:
      return json_type::only_true();
    case ConditionValue::direction:
      return json_type::choice(std::vector<std::string>(std::begin(direction_names), std::end(direction_names)));
    case ConditionValue::pressure_trace:
      return json_type::choice(std::vector<std::string>(std::begin(trace_names), std::end(trace_names)));
    default:
      return json_type::text();
  }
}

/// The row of the one condition key that the object has.
const ConditionRow& row_in(const JsonObject& object) {
  const ConditionRow* found = nullptr;
  for (const ConditionRow& row : condition_rows) {
    if (!object.has(row.key)) continue;
    if (found)
      object.value().fail(
          fmt::format("{} has both {} and {}; expected one of them", object.value().path(), found->key, row.key));
    found = &row;
  }
  if (!found)
    object.value().fail(object.value().path() +
                        " says nothing to look at; expected one of tip_passes, fed_mm, seconds, ...");
  return *found;
}

/// Reads the value of the condition's own key.
void read_own_value(const JsonObject& object, const ConditionRow& row, ScriptCondition& c) {
  switch (row.value) {
    case ConditionValue::number:
      c.value = row.unit * object.number(row.key);
      c.words = fmt::format("{} {:g}", row.key, object.number(row.key));
      return;
    case ConditionValue::only_true:
      if (!object.boolean(row.key)) object.refuse(row.key);
      c.words = row.key;
      return;
    case ConditionValue::direction: {
      const std::size_t n = object.choice(row.key, {std::begin(direction_names), std::end(direction_names)});
      c.direction_P[static_cast<Eigen::Index>(n / 2)] = n % 2 ? -1 : 1;
      c.words = fmt::format("{} {}", row.key, direction_names[n]);
      return;
    }
    case ConditionValue::pressure_trace:
      c.place = trace_names[object.choice(row.key, {std::begin(trace_names), std::end(trace_names)})];
      break;
    default:
      c.place = object.text(row.key);
  }
  c.words = fmt::format("{} {}", row.key, c.place);
}

/// Reads the keys beside it: distance, tolerance, or that the place may be missing.
void read_companions(const JsonObject& object, const ConditionRow& row, ScriptCondition& c) {
  for (const ConditionCompanion& one : condition_companions) {
    const bool belongs = std::string(row.beside) == one.key;
    if (!object.has(one.key)) {
      if (belongs && one.required)
        object.value().fail(fmt::format("{}.{} is missing; expected {}", object.value().path(), one.key, one.expected));
      continue;
    }
    if (!belongs) object.refuse(one.key);
    if (one.unit > 0)
      c.value = one.unit * object.number(one.key);
    else
      c.if_there = object.boolean(one.key);
  }
}

ScriptCondition read_condition(const JsonValue& value, const Script& script, const std::vector<int>& tools) {
  const JsonObject object(value, script_keys::condition);
  const ConditionRow& row = row_in(object);
  ScriptCondition c;
  c.file = *value.file;
  c.line = value.line;
  c.kind = row.kind;
  if (object.has("of") && row.of != ConditionOf::tool)
    object["of"].fail(fmt::format("{} has no meaning beside {}, which is about no tool", object["of"].path(), row.key));
  if (object.has("of"))
    c.tool = tool_called(script, object["of"]);
  else if (!tools.empty())
    c.tool = tools.front();
  else if (row.of == ConditionOf::tool && script.tools.size() > 1)
    value.fail(value.path() + " does not say of which tool; expected \"of\"");
  read_own_value(object, row, c);
  read_companions(object, row, c);
  if (object.has("lesion") && row.of != ConditionOf::lesion) object.refuse("lesion");
  c.lesion = read_lesion(object);
  if (c.lesion > 0) c.words += fmt::format(" of lesion {}", c.lesion + 1);
  if (tools.empty() ? object.has("of") : c.tool != tools.front()) c.words += " of " + script.tools[c.tool].name;
  return c;
}

}  // namespace

int read_lesion(const JsonObject& object) { return object.has("lesion") ? object.whole("lesion") - 1 : 0; }

int tool_called(const Script& script, const JsonValue& name) {
  std::string known;
  for (std::size_t t = 0; t < script.tools.size(); ++t) {
    if (name.type == JsonValue::Type::text && script.tools[t].name == name.text) return static_cast<int>(t);
    known += (known.empty() ? "" : ", ") + script.tools[t].name;
  }
  name.refuse("one of the script's tools: " + known);
}

std::vector<ScriptCondition> read_conditions(const JsonObject& step, const char* key, const Script& script,
                                             const std::vector<int>& tools) {
  std::vector<ScriptCondition> out;
  if (!step.has(key)) return out;
  if (step.list(key).empty()) step.refuse(key);
  for (const JsonValue& value : step.list(key)) out.push_back(read_condition(value, script, tools));
  return out;
}

JsonObjectKeys condition_keys() {
  JsonObjectKeys keys{"condition", {}, {at_least_properties(1)}, true};
  for (const ConditionRow& row : condition_rows) keys.keys.push_back({row.key, false, row.expected, type_of(row)});
  for (const ConditionCompanion& one : condition_companions) {
    std::string beside;
    for (const ConditionRow& row : condition_rows)
      if (std::string(row.beside) == one.key) beside += (beside.empty() ? "; beside " : ", ") + std::string(row.key);
    keys.keys.push_back(
        {one.key, false, one.expected + beside, one.unit > 0 ? json_type::number(one.range) : json_type::boolean()});
  }
  keys.keys.push_back({"lesion", false,
                       "which of the case's lesions, a whole number from 1 on; the first if it is not said; beside "
                       "what is about one",
                       json_type::whole(from_to(1, 100))});
  keys.keys.push_back(
      {"of", false, "which tool is meant; else the step's first; beside what is about one", json_type::text()});
  return keys;
}

bool has_condition_about_a_lesion(const JsonValue& condition) {
  return std::any_of(std::begin(condition_rows), std::end(condition_rows),
                     [&](const ConditionRow& row) { return row.of == ConditionOf::lesion && condition.find(row.key); });
}

}  // namespace ostium::data
