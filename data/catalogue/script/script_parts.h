#pragma once
/// Scripts in scripts: a step that names another script stands for its steps.
#include "data/formats/json_value.h"

namespace ostium::data {

/// Puts the steps of other scripts where `script` names them, with the values that it gives them; their values keep
/// their own file and line. Returns whether anything was written out. Throws LoadError with file, line and cure.
bool write_out_parts(JsonValue& script);

}  // namespace ostium::data
