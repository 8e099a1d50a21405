#pragma once
/// Reads the conditions of a script's steps from JSON. All functions throw LoadError with file, line and how to fix it.
#include <string>
#include <vector>

#include "data/catalogue/script/script.h"
#include "data/formats/json/json_object.h"

namespace ostium::data {

/// The keys of a condition: those of the rows, their companions, `lesion` and `of`.
JsonObjectKeys condition_keys();

/// The conditions in `step`'s list `key`; empty if it has none. A condition that names no tool is about the first of
/// `tools`.
std::vector<ScriptCondition> read_conditions(const JsonObject& step, const char* key, const Script& script,
                                             const std::vector<int>& tools);

/// Whether the condition is about one of the case's lesions, named or not.
bool has_condition_about_a_lesion(const JsonValue& condition);

/// Index of the lesion, from 0 (files count from 1); 0 if it is not given.
int read_lesion(const JsonObject& object);

/// Index of the script's tool, from 0.
int tool_called(const Script& script, const JsonValue& name);

}  // namespace ostium::data
