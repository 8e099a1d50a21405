#pragma once
/// What a step of a script looks at: its conditions, read from JSON. All throw LoadError with file, line and cure.
#include <string>
#include <vector>

#include "data/catalogue/script/script.h"
#include "data/formats/json_object.h"

namespace ostium::data {

/// The keys of a condition: those of the rows, those that stand beside them, `lesion` and `of`.
JsonObjectKeys condition_keys();

/// Of `step`'s list `key`, or none; one that does not name its tool means the first of `tools`.
std::vector<ScriptCondition> read_conditions(const JsonObject& step, const char* key, const Script& script,
                                             const std::vector<int>& tools);

/// Whether it is about one of the case's lesions, which it may not say.
bool has_condition_about_a_lesion(const JsonValue& condition);

/// Which of the case's lesions, from 0; in files from 1, and the first if it is not said.
int read_lesion(const JsonObject& object);

/// Which of the script's tools, from 0.
int tool_called(const Script& script, const JsonValue& name);

}  // namespace ostium::data
