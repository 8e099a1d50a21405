#pragma once
/// Scripts within scripts: a step that names another script is replaced by its steps.
#include "data/formats/json/json_value.h"

namespace ostium::data {

/// Replaces the steps of `script` that name other scripts by those scripts' steps, with the values given there.
/// Expanded steps keep their own file and line. Returns whether anything was expanded. Throws LoadError with file, line
/// and how to fix it.
bool write_out_parts(JsonValue& script);

}  // namespace ostium::data
