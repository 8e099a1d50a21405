#pragma once
/// Values of a script: parameters of its steps, so that one script serves where others would differ only by a number.
#include "data/formats/json/json_value.h"

namespace ostium::data {

/// Substitutes a script's values: `"values": { "pushed_mm": 40 }` defines what "$pushed_mm" stands for in its steps,
/// unless `given` (may be null) overrides it. A step with `"when": "$NAME"` is removed where that is false, one with
/// `"when_not"` where it is true. Scripts without `values` are left unchanged. Returns whether there were values.
/// Throws LoadError with file, line and how to fix it.
bool write_out_values(JsonValue& script, const JsonValue* given);

}  // namespace ostium::data
