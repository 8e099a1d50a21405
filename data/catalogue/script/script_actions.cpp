#include "data/catalogue/script/script_actions.h"

#include <fmt/format.h>

#include <algorithm>

namespace ostium::data {

namespace {

/// A step that stands for the steps of another script.
struct KeysOfAction {
  std::vector<std::string> needs, may;
};

KeysOfAction keys_of(const std::string& action) {
  if (action == stands_for_steps) return {{"script"}, {"label", "lesion", "with", "values", "otherwise", "tries"}};
  KeysOfAction keys{{}, {"label", "detour"}};
  for (const ScriptActionRow& row : script_actions) {
    if (row.name != action) continue;
    keys.needs.assign(row.needs.begin(), row.needs.end());
    keys.may.insert(keys.may.end(), row.may.begin(), row.may.end());
    if (row.may_fail) keys.may.insert(keys.may.end(), {"unless", "timeout_s", "otherwise", "tries", "last_resort"});
  }
  return keys;
}

bool is_in(const std::vector<std::string>& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

}  // namespace

std::vector<std::string> action_names() {
  std::vector<std::string> names;
  for (const ScriptActionRow& row : script_actions) names.emplace_back(row.name);
  names.emplace_back(stands_for_steps);
  return names;
}

bool may_fail(const std::string& action) {
  return std::any_of(std::begin(script_actions), std::end(script_actions),
                     [&](const ScriptActionRow& row) { return action == row.name && row.may_fail; });
}

void require_keys(const JsonObject& step) {
  const std::string action = step.text("do");
  const KeysOfAction keys = keys_of(action);
  for (const std::string& key : keys.needs)
    if (!step.has(key))
      step.value().fail(fmt::format("{}.{} is missing; \"{}\" needs it", step.value().path(), key, action));
  for (const auto& [key, value] : step.value().members)
    if (key != "do" && !is_in(keys.needs, key) && !is_in(keys.may, key))
      value.fail(fmt::format("{} has no meaning for \"{}\"", value.path(), action));
}

}  // namespace ostium::data
