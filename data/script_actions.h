#pragma once
/// What a step of a script may do, and which keys that has.
#include <string>
#include <vector>

#include "data/formats/json_object.h"

namespace ostium {

struct ScriptActionKeys {
  const char* name;
  std::vector<std::string> needs, may;
};

/// In the order of ScriptAction; behind them the one that stands for the steps of another script.
const std::vector<ScriptActionKeys>& script_actions();
inline constexpr const char* stands_for_steps = "script";

/// A step that says until when: only such may lead elsewhere.
bool may_fail(const std::string& action);

/// Throws LoadError for one that it needs and that is missing, and one that it does not have.
void require_keys(const JsonObject& step, const ScriptActionKeys& action);

}  // namespace ostium
