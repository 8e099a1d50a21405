#include "data/script_actions.h"

#include <fmt/format.h>

#include <algorithm>

namespace ostium {

const std::vector<ScriptActionKeys>& script_actions() {
  static const std::vector<std::string> ends = {"label", "unless",      "timeout_s", "otherwise",
                                                "tries", "last_resort", "detour"};
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), ends.begin(), ends.end());
    return more;
  };
  static const std::vector<ScriptActionKeys> all = {
      {"advance", {"tool", "speed_mm_s", "until"}, with({"turn_deg_s"})},
      {"withdraw", {"tool", "speed_mm_s", "until"}, with({"turn_deg_s"})},
      {"turn", {"tool", "turn_deg_s", "until"}, with({})},
      {"wait", {"until"}, with({})},
      {"view", {}, {"label", "detour", "view", "lao_deg", "cran_deg", "table_mm", "field_mm"}},
      {"fluoroscopy", {"on"}, {"label", "detour"}},
      {"cine", {"on"}, {"label", "detour"}},
      {"heart rate", {"rate_1_min"}, {"label", "detour"}},
      {"mark", {"text"}, {"label", "detour"}},
      {"inject", {"rate_mL_s", "volume_mL"}, with({"iodine_mg_mL", "until"})},
      {"inflate", {"gauge_atm", "over_s"}, with({"until"})},
      {"deflate", {}, with({"until"})},
      {"drug", {}, {"label", "detour", "heparin_U", "nitrate_ug", "adenosine_ug"}},
      {stands_for_steps, {"script"}, {"label", "lesion", "with", "otherwise", "tries"}}};
  return all;
}

bool may_fail(const std::string& action) {
  return std::any_of(script_actions().begin(), script_actions().end(), [&](const ScriptActionKeys& one) {
    return action == one.name && action != stands_for_steps &&
           std::find(one.may.begin(), one.may.end(), "otherwise") != one.may.end();
  });
}

void require_keys(const JsonObject& step, const ScriptActionKeys& action) {
  for (const std::string& key : action.needs)
    if (!step.has(key))
      step.value().fail(fmt::format("{}.{} is missing; \"{}\" needs it", step.value().path, key, action.name));
  for (const auto& [key, value] : step.value().members) {
    const auto is = [&, k = &key](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), *k) != list.end();
    };
    if (key != "do" && !is(action.needs) && !is(action.may))
      value.fail(fmt::format("{} has no meaning for \"{}\"", value.path, action.name));
  }
}

}  // namespace ostium
