#pragma once
/// What a step of a script may do, one row each, and its keys. The operator carries actions out in
/// app/session/operator/operator_actions.cpp, which does not compile while an action is missing.
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "data/formats/json/json_object.h"

namespace ostium::data {

enum class ScriptAction {
  advance,
  withdraw,
  turn,
  wait,
  view,
  fluoroscopy,
  cine,
  heart_rate,
  mark,
  inject,
  aspirate,
  inflate,
  deflate,
  drug,
  give,
  infuse,
  drain,
  shock,
  compress,
  pace,
  breathe,
  provoke
};

/// Every step may have a `label` and be a `detour`; one that can fail may also have `unless`, `timeout_s`, `otherwise`,
/// `tries` and `last_resort`.
struct ScriptActionRow {
  ScriptAction action;
  const char* name;
  std::initializer_list<const char*> needs, may;
  bool may_fail;
};

inline constexpr ScriptActionRow script_actions[] = {
    {ScriptAction::advance, "advance", {"tool", "speed_mm_s", "until"}, {"turn_deg_s"}, true},
    {ScriptAction::withdraw, "withdraw", {"tool", "speed_mm_s", "until"}, {"turn_deg_s"}, true},
    {ScriptAction::turn, "turn", {"tool", "turn_deg_s", "until"}, {}, true},
    {ScriptAction::wait, "wait", {"until"}, {}, true},
    {ScriptAction::view, "view", {}, {"view", "lao_deg", "cran_deg", "table_mm", "field_mm"}, false},
    {ScriptAction::fluoroscopy, "fluoroscopy", {"on"}, {}, false},
    {ScriptAction::cine, "cine", {"on"}, {}, false},
    {ScriptAction::heart_rate, "heart rate", {"rate_1_min"}, {}, false},
    {ScriptAction::mark, "mark", {}, {"text"}, false},
    {ScriptAction::inject, "inject", {"rate_mL_s", "volume_mL"}, {"iodine_mg_mL", "until"}, true},
    {ScriptAction::aspirate, "aspirate", {"rate_mL_s", "volume_mL"}, {"until"}, true},
    {ScriptAction::inflate, "inflate", {"gauge_atm", "over_s"}, {"tool", "until"}, true},
    {ScriptAction::deflate, "deflate", {}, {"tool", "until"}, true},
    {ScriptAction::drug, "drug", {}, {"heparin_U", "nitrate_ug", "adenosine_ug"}, false},
    {ScriptAction::give, "give", {"drug"}, {"dose_ug", "dose_mg"}, false},
    {ScriptAction::infuse, "infuse", {"rate_mL_s", "volume_mL"}, {"until"}, true},
    {ScriptAction::drain, "drain", {"rate_mL_s", "volume_mL"}, {"until"}, true},
    {ScriptAction::shock, "shock", {"energy_J"}, {}, false},
    {ScriptAction::compress, "compress", {"rate_1_min", "until"}, {}, true},
    {ScriptAction::pace, "pace", {"rate_1_min", "current_mA"}, {}, false},
    {ScriptAction::breathe, "breathe", {}, {"hold"}, false},
    {ScriptAction::provoke,
     "provoke",
     {"complication"},
     {"at", "hole_mm", "grade", "share", "clot_mm3", "air_mL"},
     false}};

inline constexpr int action_kinds = static_cast<int>(std::size(script_actions));

/// The row of an action.
constexpr const ScriptActionRow& row_of(ScriptAction action) {
  for (const ScriptActionRow& row : script_actions)
    if (row.action == action) return row;
  throw "every action has a row";
}

/// Checks that each action has exactly one row.
constexpr bool each_action_has_a_row() {
  for (int action = 0; action < action_kinds; ++action) row_of(static_cast<ScriptAction>(action));
  return true;
}
static_assert(each_action_has_a_row());

/// Whether the action needs a circulation, which a mesh or a vessel without an aorta does not have.
constexpr bool needs_patient(ScriptAction action) {
  return action == ScriptAction::inject || action == ScriptAction::inflate || action == ScriptAction::deflate ||
         action == ScriptAction::drug || action == ScriptAction::aspirate || action == ScriptAction::give ||
         action == ScriptAction::infuse || action == ScriptAction::drain || action == ScriptAction::shock ||
         action == ScriptAction::compress || action == ScriptAction::pace || action == ScriptAction::breathe ||
         action == ScriptAction::provoke;
}

/// The value of "do" for a step that stands for the steps of another script.
inline constexpr const char* stands_for_steps = "script";

/// All allowed values of "do".
std::vector<std::string> action_names();

/// Whether the action has an `until`: only such a step can fail and jump elsewhere.
bool may_fail(const std::string& action);

/// Throws LoadError if a key that the step's action needs is missing, or if it has a key that does not belong to it.
void require_keys(const JsonObject& step);

}  // namespace ostium::data
